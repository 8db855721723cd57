#include "gloam/scene/camera_ray.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "gloam/error.h"
#include "gloam/projection.h"

namespace gloam {

TracerRay camera_ray(const Camera& camera, const glm::dvec3& scene_origin, double x, double y) {
  const std::optional<ViewRay> seen = view_ray(camera, {x, y});
  if (!seen) throw Error("nothing is shown at ({:g}, {:g}): the module's light misses the screen", x, y);
  const glm::dmat3 to_world = glm::transpose(camera.pose->world_to_view);
  const glm::dvec3 eye = camera.pose->position - scene_origin;
  TracerRay ray;
  ray.origin = eye + to_world * seen->start;
  ray.direction = to_world * seen->per_depth;
  return ray;
}

}  // namespace gloam
