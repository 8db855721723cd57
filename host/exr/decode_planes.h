// From the channels of an EXR file to the planes of a frame, with values as they stand in the file.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// NaN and infinite values, by plane and view.
using NonfiniteCounts = std::map<std::pair<std::string, std::string>, long long>;

/// The planes, of all views that have them, of the rows that `window` covers, which is as wide as the file's. Layers that a view
/// lacks are filled, the others are still to be decoded.
Frame allocate_planes(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& planes,
                      const Window& window);

/// Throws Error naming the file where it is damaged.
void decode_planes(const ExrFile& file, Frame& frame);

/// Inside the data windows, since the rest is not in the file.
void add_nonfinite(const ExrFile& file, const Frame& frame, NonfiniteCounts& counts);

}  // namespace gloam
