#include "scene/captured_pixels.h"

#include <limits>

#include "gloam/projection.h"

namespace gloam {

double far_of(const Camera& camera) { return camera.far.value_or(std::numeric_limits<double>::infinity()); }

bool shows(const Camera& camera, int x, int y) {
  return !camera.slits || view_ray(camera, {x + 0.5, y + 0.5}).has_value();
}

}  // namespace gloam
