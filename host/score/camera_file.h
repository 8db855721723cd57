// The cameras of a frame as a camera JSON, for other programs.
#pragma once

#include <filesystem>

namespace gloam::score {

/// Writes the cameras of all views (docs/gbuffer.md). Throws Error for a frame without a camera, or with one that no camera JSON holds.
void write_camera_file(const std::filesystem::path& file, const std::filesystem::path& frame);

}  // namespace gloam::score
