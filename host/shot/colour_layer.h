// The colour of a frame as its file stores it, for a composite.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame_files.h"

namespace gloam {

struct ColourLayer {
  FrameFiles files;
  std::vector<std::string>
      planes;  ///< colour, alpha where there is one, and what tells which of its light occlusion darkens
  std::vector<std::string> half_planes;  ///< those that the file stores as half
  int part = 0;                          ///< of the first file
};

/// What files call the planes that tell which of the colour's light occlusion darkens: {"emission", "ViewLayer.Emit"}.
std::map<std::string, std::string> names_of_light(const FrameFiles& files);

/// Notes on which light of a colour occlusion does not darken, and which it darkens alone.
std::vector<std::string> notes_on_darkening(const ColourLayer& layer, const Frame& colour);

/// A note for each Cryptomatte of a frame's file, which a composite by itself lacks.
std::vector<std::string> notes_on_cryptomattes(const std::filesystem::path& file);

/// Opens the frame's files once more, for values without any change. Throws Error if there is no colour.
ColourLayer open_colour(const std::vector<std::string>& paths, const ReadOptions& options);

/// Decodes the layer's planes, without those that turn out to be no part of the colour. Appends sentences on those, and on values that are no
/// light, which a composite keeps.
Frame read_layer(ColourLayer& layer, std::vector<std::string>& notes);

}  // namespace gloam
