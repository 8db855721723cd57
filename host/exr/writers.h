// Programs and data sets that write each plane as a file of its own, under names that tell what it is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// Where the path of a frame is that of a writer's depth (data/writers.json): adds the files of the other planes that lie where the writer
/// puts them, and states what its depth means, its field of view or camera, unless `options` state another. A sentence in `notes` says so.
/// Throws Error for a calibration file that cannot be read.
void take_writer(const std::filesystem::path& depth, ReadOptions& options, std::vector<std::string>& notes);

/// Of a folder that is given for a frame: what to name instead. Looks three folders deep.
std::string advice_on_folder(const std::filesystem::path& folder);

}  // namespace gloam
