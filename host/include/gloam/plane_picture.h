// One plane as a PNG.
#pragma once

#include <filesystem>

#include "gloam/frame.h"

namespace gloam {

/// One plane as an 8-bit PNG: grey for one component (0..1), normals as 0.5 + 0.5 n, others clamped to 0..1 through
/// sRGB. `depth`, where given, tells where no surface is: hatched there, as nothing that is open is.
void write_picture(const std::filesystem::path& path, const Plane& plane, const Plane* depth = nullptr);

}  // namespace gloam
