#include "analytic_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "base/low_discrepancy.h"

namespace gloam::analytic {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distance above a surface at which rays leave it, metres: far above double's rounding, far below any modelled size.
constexpr double lift = 1e-7;

/// The part of a line inside a convex solid, and the face at either end: the axis of a box; 0 for the side and 1 for the caps of
/// a frustum.
struct Span {
  double enter = infinity, leave = -infinity;
  int enter_face = 0, leave_face = 0;
  bool empty() const { return enter >= leave; }
};

/// Intersects a span with the space between two parallel planes.
void clip_to_slab(Span& span, double origin, double direction, double half, int face) {
  if (direction == 0) {
    if (std::abs(origin) > half) span = Span{};
    return;
  }
  const double inverse = 1 / direction, reach = half * std::abs(inverse), middle = -origin * inverse;
  if (middle - reach > span.enter) span.enter = middle - reach, span.enter_face = face;
  if (middle + reach < span.leave) span.leave = middle + reach, span.leave_face = face;
}

Span box_span(const Solid& solid, const dvec3& o, const dvec3& d) {
  Span span{-infinity, infinity};
  for (int axis = 0; axis < 3; ++axis) clip_to_slab(span, o[axis], d[axis], solid.half[axis], axis);
  return span;
}

Span sphere_span(const Solid& solid, const dvec3& o, const dvec3& d) {
  const double b = glm::dot(o, d);
  const double discriminant = b * b - glm::dot(o, o) + solid.radius * solid.radius;
  if (discriminant <= 0) return {};
  const double root = std::sqrt(discriminant);
  return {-b - root, -b + root};
}

/// Roots of a t^2 + 2 b t + c = 0 in rising order, without cancellation; the discriminant is not negative.
std::pair<double, double> roots(double a, double b, double c, double discriminant) {
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double t0 = q / a, t1 = q != 0 ? c / q : t0;
  return {std::min(t0, t1), std::max(t0, t1)};
}

/// The part of a line inside the side of a frustum without its caps. Only the nappe with a positive radius counts; the other lies
/// beyond a cap.
Span cone_span(const Solid& solid, const dvec3& o, const dvec3& d) {
  const double radius = solid.radius + solid.slope * o.y, growth = solid.slope * d.y;
  const double a = d.x * d.x + d.z * d.z - growth * growth;
  const double b = o.x * d.x + o.z * d.z - radius * growth;
  const double c = o.x * o.x + o.z * o.z - radius * radius;
  if (std::abs(a) < 1e-14) {  // parallel to the axis or to the side: one crossing or none
    if (std::abs(b) < 1e-14) return c < 0 ? Span{-infinity, infinity} : Span{};
    return b > 0 ? Span{-infinity, -c / (2 * b)} : Span{-c / (2 * b), infinity};
  }
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return {};
  const auto [t0, t1] = roots(a, b, c, discriminant);
  if (a > 0) return {t0, t1};
  return growth > 0 ? Span{t1, infinity} : Span{-infinity, t0};
}

Span frustum_span(const Solid& solid, const dvec3& o, const dvec3& d) {
  Span span = cone_span(solid, o, d);
  if (!span.empty()) clip_to_slab(span, o.y, d.y, solid.half.y, 1);
  return span;
}

Span span_of(const Solid& solid, const Ray& ray) {
  dvec3 o = ray.origin - solid.centre, d = ray.direction;
  if (solid.rotated) o = solid.to_local * o, d = solid.to_local * d;
  switch (solid.shape) {
    case Solid::box:
      return box_span(solid, o, d);
    case Solid::sphere:
      return sphere_span(solid, o, d);
    default:
      return frustum_span(solid, o, d);
  }
}

/// Outward normal of a face at a point on it.
dvec3 normal_at(const Solid& solid, const dvec3& point, int face) {
  const dvec3 p = solid.to_local * (point - solid.centre);
  dvec3 n = p;
  if (solid.shape == Solid::box || (solid.shape == Solid::frustum && face == 1)) {
    n = dvec3(0);
    n[face] = std::copysign(1.0, p[face]);
  } else if (solid.shape == Solid::frustum) {
    n.y = -solid.slope * std::hypot(p.x, p.z);
  }
  return glm::transpose(solid.to_local) * glm::normalize(n);
}

/// The crossing of a ray with an object: its distance, solid and face.
struct Crossing {
  double distance = infinity;
  const Solid* solid = nullptr;
  int face = 0;
};

/// Follows the ray from where it enters the body, leaving each cut that contains the position, to the first position inside the
/// body and outside all cuts. A ray that starts inside the remaining solid meets it at once.
Crossing cross(const Object& object, const Ray& ray) {
  const Span body = span_of(object.body, ray);
  if (body.empty() || body.leave <= 0) return {};
  Crossing at{std::max(body.enter, 0.0), &object.body, body.enter_face};
  for (size_t i = 0; i < object.cuts.size(); ++i) {
    const Span cut = span_of(object.cuts[i], ray);
    if (cut.enter > at.distance || cut.leave <= at.distance) continue;
    at = {cut.leave, &object.cuts[i], cut.leave_face};
    if (at.distance >= body.leave) return {};
    i = size_t(-1);  // the position has moved: test every cut again
  }
  return at;
}

/// Whether a ray can touch the bounds: the slab test, without faces.
bool may_touch(const Bounds& bounds, const Ray& ray, const dvec3& inverse) {
  const dvec3 a = (bounds.low - ray.origin) * inverse, b = (bounds.high - ray.origin) * inverse;
  double enter = 0, leave = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0) continue;  // let the exact test decide
    enter = std::max(enter, std::min(a[axis], b[axis]));
    leave = std::min(leave, std::max(a[axis], b[axis]));
  }
  return enter <= leave;
}

/// Whether part of the bounds is within `radius` of the point and above its tangent plane.
bool can_occlude(const Bounds& bounds, const dvec3& point, const dvec3& normal, double radius) {
  const dvec3 nearest = glm::clamp(point, bounds.low, bounds.high);
  if (glm::distance(nearest, point) >= radius) return false;
  dvec3 highest;
  for (int axis = 0; axis < 3; ++axis) highest[axis] = normal[axis] > 0 ? bounds.high[axis] : bounds.low[axis];
  return glm::dot(highest - point, normal) > lift;
}

}  // namespace

Solid make_box(const dvec3& low, const dvec3& high) {
  Solid solid;
  solid.centre = 0.5 * (low + high);
  solid.half = 0.5 * (high - low);
  return solid;
}

Solid make_sphere(const dvec3& centre, double radius) {
  Solid solid;
  solid.shape = Solid::sphere;
  solid.centre = centre;
  solid.half = dvec3(radius);
  solid.radius = radius;
  return solid;
}

Solid make_frustum(const dvec3& from, const dvec3& to, double radius_from, double radius_to) {
  const double length = glm::distance(from, to), widest = std::max(radius_from, radius_to);
  Solid solid;
  solid.shape = Solid::frustum;
  solid.centre = 0.5 * (from + to);
  solid.half = dvec3(widest, 0.5 * length, widest);
  solid.radius = 0.5 * (radius_from + radius_to);
  solid.slope = (radius_to - radius_from) / length;
  const dvec3 axis = (to - from) / length;
  solid.rotated = axis != dvec3(0, 1, 0);
  if (solid.rotated) {
    const dmat3 about = frame_about(axis);
    solid.to_local = glm::transpose(dmat3(about[1], about[2], about[0]));
  }
  return solid;
}

Solid placed(Solid solid, double yaw, const dvec3& offset) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  const dmat3 turn(dvec3(c, 0, -s), dvec3(0, 1, 0), dvec3(s, 0, c));
  solid.centre = turn * solid.centre + offset;
  const bool round = solid.shape == Solid::sphere || (solid.shape == Solid::frustum && !solid.rotated);
  if (yaw == 0 || round) return solid;
  solid.to_local = solid.to_local * glm::transpose(turn);
  solid.rotated = true;
  return solid;
}

Bounds bounds_of(const Solid& solid) {
  dvec3 reach = solid.half;
  if (solid.rotated) {
    const dmat3 to_world = glm::transpose(solid.to_local);
    reach = glm::abs(to_world[0]) * solid.half.x + glm::abs(to_world[1]) * solid.half.y +
            glm::abs(to_world[2]) * solid.half.z;
  }
  return {solid.centre - reach, solid.centre + reach};
}

void Scene::add(const Solid& body, const glm::vec3& albedo, const std::vector<Solid>& cuts) {
  objects.push_back({body, cuts, albedo, bounds_of(body)});
}

std::optional<Hit> first_hit(const Scene& scene, const Ray& ray) {
  const dvec3 inverse = 1.0 / ray.direction;
  Crossing nearest;
  const Object* object = nullptr;
  for (const Object& candidate : scene.objects) {
    if (!may_touch(candidate.bounds, ray, inverse)) continue;
    const Crossing crossing = cross(candidate, ray);
    if (crossing.distance < nearest.distance) nearest = crossing, object = &candidate;
  }
  if (!object) return {};
  const dvec3 outward = normal_at(*nearest.solid, ray.origin + nearest.distance * ray.direction, nearest.face);
  return Hit{nearest.distance, nearest.solid == &object->body ? outward : -outward, object};
}

bool blocked(const Scene& scene, const Ray& ray, double reach) {
  const dvec3 inverse = 1.0 / ray.direction;
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    return may_touch(object.bounds, ray, inverse) && cross(object, ray).distance < reach;
  });
}

Visibility ambient_visibility(const Scene& scene, const dvec3& point, const dvec3& normal, double radius, int samples,
                              uint32_t seed) {
  std::vector<const Object*> near;
  for (const Object& object : scene.objects) {
    if (can_occlude(object.bounds, point, normal, radius)) near.push_back(&object);
  }
  if (near.empty()) return {};

  const dmat3 to_world = frame_about(normal);
  const dvec3 origin = point + lift * normal;
  const int half = samples / 2;
  double open[2] = {0, 0};
  for (int part = 0; part < 2; ++part) {
    const uint32_t part_seed = hash(2 * seed + uint32_t(part));
    for (int i = 0; i < half; ++i) {
      const Ray ray{origin, to_world * cosine_direction(scrambled_sobol(uint32_t(i), part_seed))};
      const bool hit =
          std::any_of(near.begin(), near.end(), [&](const Object* o) { return cross(*o, ray).distance < radius; });
      if (!hit) open[part] += 1;
    }
  }
  return {(open[0] + open[1]) / (2 * half), (open[0] - open[1]) / half};
}

}  // namespace gloam::analytic
