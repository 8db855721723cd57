#include "stress/surfaces.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gloam::stress {

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

float depth_at(const Shot& shot, const Scene& scene, int x, int y) {
  const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
  return seen ? float(seen->depth) : std::numeric_limits<float>::infinity();
}

Scene nearest_of(const std::vector<Scene>& scenes) {
  return [=](const EyeRay& ray) {
    std::optional<Surface> nearest;
    for (const Scene& scene : scenes) {
      const auto seen = scene(ray);
      if (seen && (!nearest || seen->depth < nearest->depth)) nearest = seen;
    }
    return nearest;
  };
}

Scene ball(const glm::dvec3& centre, double radius) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const glm::dvec3 from = ray.origin - centre;
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.direction, from);
    const double root = b * b - a * (glm::dot(from, from) - radius * radius);
    if (root < 0) return {};
    const double depth = (-b - std::sqrt(root)) / a;
    return Surface{depth, glm::normalize(point_at(ray, depth) - centre)};
  };
}

Scene corner(double tilt) {
  const double up = std::numbers::pi / 2;
  return nearest_of({tilted_plane(4, std::numbers::pi / 4, up), tilted_plane(4, tilt, -up)});
}

Scene step(double rise) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    return Surface{ray.origin.x > 0 ? 4 - rise : 4.0, {0, 0, 1}};
  };
}

Scene near_and_far() {
  return [](const EyeRay& ray) -> std::optional<Surface> {
    const glm::dvec3 side = ray.origin + ray.direction;
    const bool near = side.y > 0 ? side.x > 0 : (long(std::floor(side.x * 40)) & 1) != 0;
    return Surface{near ? 1e-6 : 1e6, {0, 0, 1}};
  };
}

}  // namespace gloam::stress
