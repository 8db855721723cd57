// One plane as a PNG.
#pragma once

#include <filesystem>

#include "gloam/frame.h"

namespace gloam {

/// Writes one plane as an 8-bit PNG: grey for one component (0..1), normals as 0.5 + 0.5 n, others clamped to 0..1 through sRGB.
/// With `depth`, background is hatched, unlike any open surface.
void write_picture(const std::filesystem::path& path, const Plane& plane, const Plane* depth = nullptr);

}  // namespace gloam
