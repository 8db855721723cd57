#include "run/kernel_projection.h"

#include <algorithm>
#include <bit>
#include <glm/matrix.hpp>

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;

void put(double (&rows)[9], const dmat3& m) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rows[3 * row + column] = m[column][row];
}

void put(double (&to)[3], const dvec3& v) { std::copy_n(&v.x, 3, to); }

/// Sets the map from this view space into the other's, if both poses are known.
void set_motion(ProjectionOfDoubles& p, const Camera& own, const Camera& other) {
  put(p.rotation, dmat3(1.0));
  put(p.translation, dvec3(0));
  if (!own.pose || !other.pose) return;
  put(p.rotation, other.pose->world_to_view * glm::transpose(own.pose->world_to_view));
  put(p.translation, other.pose->world_to_view * (own.pose->position - other.pose->position));
}

void set_straight(ProjectionOfDoubles& p, double centre_x, double centre_y, double scale_x, double scale_y) {
  p.is_straight = 1;
  p.scale_x = scale_x;
  p.scale_y = scale_y;
  p.centre_x = centre_x;
  p.centre_y = centre_y;
}

void set_one_eye(ProjectionOfDoubles& p, const Camera& c) {
  set_straight(p, c.cx, c.cy, 1 / c.fx, 1 / c.fy);
  p.grow_x = p.grow_y = c.orthographic ? 0 : 1;
  p.base_x = p.base_y = c.orthographic ? 1 : 0;
}

bool is_straight(const TwoSlits& s) {
  const dmat3& k = s.to_physical;
  return !s.screen_radius && s.turn == dmat3(1.0) && k[1][0] == 0 && k[2][0] == 0 && k[2][1] == 0;
}

/// x = (module.x + slope * (z - module.z)) / k: slopes across and up change evenly from column to column and from row to row.
void set_straight_slits(ProjectionOfDoubles& p, const Camera& c) {
  const TwoSlits& s = *c.slits;
  const double kx = s.to_physical[0][0], ky = s.to_physical[1][1], kz = s.to_physical[2][2], behind = -s.module.z;
  // The row whose light leaves the screen at the observers' height.
  const double level = c.cy + (s.module.y - s.observer_height) * c.fy / behind;
  set_straight(p, c.cx, level, kz / (kx * c.fx), behind * kz / (s.observer_distance * ky * c.fy));
  p.origin_x = s.module.x / kx;
  p.grow_x = -1;
  p.base_x = (s.observer_distance + behind) / kz;
  p.grow_y = 1;
  p.base_y = 0;
}

void set_slits(ProjectionOfDoubles& p, const Camera& c) {
  const TwoSlits& s = *c.slits;
  p.is_curved = s.screen_radius.has_value();
  put(p.to_physical, s.to_physical);
  put(p.from_physical, glm::inverse(s.to_physical));
  put(p.view_origin, dvec3(0, s.observer_height, s.observer_distance) - s.module);
  p.observer_up = s.observer_height - s.module.y;
  p.observer_ahead = s.observer_distance - s.module.z;
  p.screen_ahead = -s.module.z;
  if (s.screen_radius) {
    const double r = *s.screen_radius;
    p.circle_x = s.module.x;
    p.circle_z = s.module.z + r;
    p.circle_constant = p.circle_x * p.circle_x + s.module.z * (s.module.z + 2 * r);
  }
  put(p.turn, glm::transpose(s.turn));
  p.fx = c.fx;
  p.fy = c.fy;
  p.cx = c.cx;
  p.cy = c.cy;
  if (is_straight(s)) set_straight_slits(p, c);
}

/// Reduced pixel X is pixel X * scale.
void reduce(ProjectionOfDoubles& p, const Window& window, int scale) {
  const auto centre = [scale](double pixels) { return (pixels - 0.5) / scale + 0.5; };
  p.centre_x = centre(p.centre_x - window.x0);
  p.centre_y = centre(p.centre_y - window.y0);
  p.cx = centre(p.cx - window.x0);
  p.cy = centre(p.cy - window.y0);
  p.scale_x *= scale;
  p.scale_y *= scale;
  p.fx /= scale;
  p.fy /= scale;
}

}  // namespace

glm::dvec3 position_origin(const View& view, bool are_computed) {
  if (!are_computed) return view.origin;
  return view.camera && view.camera->pose ? view.camera->pose->position : dvec3(0);
}

ProjectionOfDoubles kernel_projection(const Frame& frame, const View& own, const View& view, int scale,
                                      bool are_computed) {
  const Camera& camera = *view.camera;
  ProjectionOfDoubles p{};
  set_motion(p, *own.camera, camera);
  const Pose pose = camera.pose.value_or(Pose{});
  put(p.to_view, pose.world_to_view);
  if (camera.pose) put(p.shift, pose.world_to_view * (position_origin(view, are_computed) - pose.position));
  if (camera.slits)
    set_slits(p, camera);
  else
    set_one_eye(p, camera);
  reduce(p, frame.window, scale);
  return p;
}

ProjectionOfFloats in_floats(const ProjectionOfDoubles& projection) {
  constexpr size_t count = (sizeof(ProjectionOfDoubles) - 2 * sizeof(int)) / sizeof(double);
  struct Doubles {
    int choices[2];
    double numbers[count];
  };
  struct Floats {
    int choices[2];
    float numbers[count];
  };
  const Doubles from = std::bit_cast<Doubles>(projection);
  Floats to;
  std::copy_n(from.choices, 2, to.choices);
  std::transform(from.numbers, from.numbers + count, to.numbers, [](double value) { return float(value); });
  return std::bit_cast<ProjectionOfFloats>(to);
}

}  // namespace gloam
