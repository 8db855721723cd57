// A camera from a field of view alone.
#pragma once

#include <string>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// A camera with the given horizontal field of view over the display window, centred, without a pose. `pixel_aspect`: width of
/// a pixel over its height. Throws UsageError unless 1 to 179 degrees.
Camera camera_from_fov(double degrees, const Window& display, double pixel_aspect, const std::string& source);

}  // namespace gloam
