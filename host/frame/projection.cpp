#include "gloam/projection.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Distance along z from the module to where its light, moving sideways by `slope` per z, meets the screen; none if it never does.
std::optional<double> reach_of_screen(const TwoSlits& s, double slope) {
  if (!s.screen_radius) return -s.module.z;
  // (x, z) = module + t (slope, 1) on the circle about (0, -radius); the outer crossing is on the screen's front.
  const double r = *s.screen_radius, x = s.module.x, z = s.module.z + r;
  const double a = 1 + slope * slope, b = slope * x + z, c = x * x + s.module.z * (s.module.z + 2 * r);
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return {};
  const double root = std::sqrt(discriminant);
  // Two forms of the same root: one of them would subtract almost equal numbers.
  return b > 0 ? -c / (b + root) : (root - b) / a;
}

/// Direction of a light ray in physical space: sideways and up per z towards the observers.
struct Slopes {
  double across, up;
};

dvec3 observer_of(const TwoSlits& s) { return {0, s.observer_height, s.observer_distance}; }

/// Direction of a pixel's light after the screen has spread it upwards and downwards.
std::optional<Slopes> slopes_of(const Camera& camera, const dvec2& place) {
  const TwoSlits& s = *camera.slits;
  const dvec3 out = s.turn * dvec3((place.x - camera.cx) / camera.fx, (camera.cy - place.y) / camera.fy, 1);
  if (!(out.z > 0)) return {};
  const Slopes from_module{out.x / out.z, out.y / out.z};
  const std::optional<double> reach = reach_of_screen(s, from_module.across);
  if (!reach || !(*reach > 0)) return {};
  const dvec3 spot = s.module + *reach * dvec3(from_module.across, from_module.up, 1);
  const bool is_on_screen = std::abs(spot.x) <= 0.5 * s.screen_width && std::abs(spot.y) <= 0.5 * s.screen_height;
  if (!is_on_screen || !(spot.z < s.observer_distance)) return {};
  return Slopes{from_module.across, (s.observer_height - spot.y) / (s.observer_distance - spot.z)};
}

ViewRay slit_ray(const TwoSlits& s, const Slopes& slopes) {
  const double from_module = s.observer_distance - s.module.z;
  // Starts on the observer line; depth grows against z.
  const dvec3 start(s.module.x + slopes.across * from_module, 0, 0), per_z(slopes.across, slopes.up, 1);
  const glm::dmat3 to_view = glm::inverse(s.to_physical);
  return {to_view * start, to_view * (per_z * -s.to_physical[2][2])};
}

std::optional<dvec2> project_through_slits(const Camera& camera, const dvec3& point) {
  const TwoSlits& s = *camera.slits;
  const dvec3 p = s.to_physical * point + observer_of(s);
  if (!(p.z < s.observer_distance && p.z > s.module.z)) return {};
  const double across = (p.x - s.module.x) / (p.z - s.module.z);
  const double up = (s.observer_height - p.y) / (s.observer_distance - p.z);
  const std::optional<double> reach = reach_of_screen(s, across);
  if (!reach || !(*reach > 0)) return {};
  const double z = s.module.z + *reach;
  if (!(z < s.observer_distance)) return {};
  const dvec3 spot(s.module.x + across * *reach, s.observer_height - up * (s.observer_distance - z), z);
  const dvec3 seen = glm::transpose(s.turn) * (spot - s.module);
  if (!(seen.z > 0)) return {};
  return dvec2(camera.cx + camera.fx * seen.x / seen.z, camera.cy - camera.fy * seen.y / seen.z);
}

}  // namespace

std::optional<ViewRay> view_ray(const Camera& camera, const dvec2& place) {
  if (camera.slits) {
    const std::optional<Slopes> slopes = slopes_of(camera, place);
    return slopes ? std::optional(slit_ray(*camera.slits, *slopes)) : std::nullopt;
  }
  const double across = (place.x - camera.cx) / camera.fx, up = (camera.cy - place.y) / camera.fy;
  if (camera.orthographic) return ViewRay{{across, up, 0}, {0, 0, -1}};
  return ViewRay{{0, 0, 0}, {across, up, -1}};
}

std::optional<dvec2> pixel_of(const Camera& camera, const dvec3& point) {
  if (camera.slits) return project_through_slits(camera, point);
  const double depth = -point.z, along = camera.orthographic ? 1 : depth;
  if (!(depth > 0)) return {};
  return dvec2(camera.cx + camera.fx * point.x / along, camera.cy - camera.fy * point.y / along);
}

std::optional<dvec2> pixel_of_world(const Camera& camera, const dvec3& world, double w) {
  if ((camera.orthographic || camera.slits) && w == 0) return {};
  return pixel_of(camera, camera.pose->world_to_view * (world - w * camera.pose->position));
}

double depth_of_slit(const Camera& camera) {
  if (!camera.slits) return std::numeric_limits<double>::infinity();
  return (camera.slits->observer_distance - camera.slits->module.z) / camera.slits->to_physical[2][2];
}

double pixels_per_unit(const Camera& camera, double depth) {
  if (!camera.slits) return camera.fx / (camera.orthographic ? 1 : depth);
  const TwoSlits& s = *camera.slits;
  const double from_module = s.observer_distance - s.module.z - s.to_physical[2][2] * depth;
  return camera.fx * s.to_physical[0][0] / from_module;
}

}  // namespace gloam
