// Decodes the channels of an EXR file into the planes of a frame, with values as in the file.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// Number of NaN and infinite values, by plane and view.
using NonfiniteCounts = std::map<std::pair<std::string, std::string>, long long>;

/// Allocates the planes, for all views that have them and the rows of `window`, which is as wide as the file's. Fills the layers
/// that a view lacks; the others are to be decoded.
Frame allocate_planes(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& planes,
                      const Window& window);

/// Throws Error naming the file if it is damaged.
void decode_planes(const ExrFile& file, Frame& frame);

/// Counts inside the data windows: the file has no other values.
void add_nonfinite(const ExrFile& file, const Frame& frame, NonfiniteCounts& counts);

}  // namespace gloam
