#include "frame/field_of_view.h"

#include <cmath>
#include <numbers>

#include "gloam/error.h"

namespace gloam {

Camera camera_from_fov(double degrees, const Window& display, double pixel_aspect, const std::string& source) {
  if (!(degrees >= 1 && degrees <= 179))
    throw UsageError("{} {:g} is not allowed; a horizontal field of view of 1 to 179 degrees is", source, degrees);
  Camera camera;
  camera.fx = display.width() / 2.0 / std::tan(degrees * std::numbers::pi / 360);
  camera.fy = camera.fx * pixel_aspect;  // lower pixels: more of them on the same length
  camera.cx = (display.x0 + display.x1) / 2.0;
  camera.cy = (display.y0 + display.y1) / 2.0;
  camera.source = source;
  return camera;
}

}  // namespace gloam
