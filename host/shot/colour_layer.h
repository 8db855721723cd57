// The colour of a frame as its file stores it, for a composite.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame_files.h"

namespace gloam {

struct ColourLayer {
  FrameFiles files;
  std::vector<std::string> planes;       ///< colour, and alpha where there is one
  std::vector<std::string> half_planes;  ///< those that the file stores as half
  int part = 0;                          ///< of the first file
};

/// Opens the frame's files once more, for values without any change. Throws Error if there is no colour.
ColourLayer open_colour(const std::vector<std::string>& paths, const ReadOptions& options);

/// Decodes the layer's planes. Appends a sentence on values that are no light, which a composite keeps.
Frame read_layer(ColourLayer& layer, std::vector<std::string>& notes);

}  // namespace gloam
