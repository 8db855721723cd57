#include "scene/random_camera.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gloam/projection.h"

namespace gloam {
namespace {

/// The surface that a random pixel of a camera shows; world.
std::optional<glm::dvec3> seen_at_random(const Tracer& tracer, const Camera& camera, int width, int height,
                                         Random& random) {
  const double x = random.uniform(0, width), y = random.uniform(0, height);
  const std::optional<ViewRay> ray = view_ray(camera, {x, y});
  const glm::dmat3 to_world = glm::transpose(camera.pose->world_to_view);
  TracerRay traced;
  traced.origin = camera.pose->position - tracer.scene().origin + to_world * ray->start;
  traced.direction = glm::normalize(to_world * ray->per_depth);
  const std::optional<Surface> surface = tracer.first(traced);
  if (!surface) return {};
  return surface->position + tracer.scene().origin;
}

}  // namespace

std::optional<SceneCamera> random_camera(const Tracer& tracer, Random& random) {
  const SceneCamera& from = random.pick(tracer.scene().cameras);
  const Camera camera = camera_for(from, 640, 360);
  const auto ahead = seen_at_random(tracer, camera, 640, 360, random);
  const auto target = seen_at_random(tracer, camera, 640, 360, random);
  const double share = random.uniform(0, 0.65);
  const double fov = random.uniform(45, 80);
  if (!ahead || !target) return {};
  const glm::dvec3 eye = from.pose.position + share * (*ahead - from.pose.position);
  return looking_at("random", eye, *target, fov, tracer.scene().up);
}

SurfaceShares surface_shares(const Channel& depth, double radius) {
  SurfaceShares shares;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x) {
      if (is_background(depth.at(x, y))) continue;
      ++shares.surfaces;
      if (depth.at(x, y) < radius) ++shares.near;
    }
  const double pixels = double(depth.layout().width) * depth.layout().height;
  return {shares.surfaces / pixels, shares.near / pixels};
}

bool shows_enough(const SurfaceShares& shares) { return shares.surfaces >= 0.4 && shares.near <= 0.1; }

}  // namespace gloam
