// A scene of solids with closed-form ray intersection, and its exact ambient occlusion.
//
// All in double and in world space, metres, y up. There are no meshes and no acceleration structure: intersections are solved
// for, so that depths, normals and occlusion have no modelling error.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace gloam::analytic {

struct Ray {
  glm::dvec3 origin;
  glm::dvec3 direction;  ///< unit
};

/// A convex solid: a line meets it in one interval, so cutting solids out of solids is a walk over intervals.
struct Solid {
  enum Shape { box, sphere, frustum };
  Shape shape = box;
  glm::dvec3 centre{0.0};
  glm::dmat3 to_local{1.0};  ///< rotation: local = to_local * (world - centre)
  bool rotated = false;      ///< false: `to_local` is the identity and is skipped
  glm::dvec3 half{0.0};      ///< half extents; frustum: only y is used
  double radius = 0;         ///< sphere: its radius; frustum: radius halfway up
  double slope = 0;          ///< frustum: radius gained per unit of local y; 0: a cylinder
};

Solid make_box(const glm::dvec3& low, const glm::dvec3& high);
Solid make_sphere(const glm::dvec3& centre, double radius);
/// A capped cone between two points, with a radius at each; equal radii make a cylinder.
Solid make_frustum(const glm::dvec3& from, const glm::dvec3& to, double radius_from, double radius_to);
/// The solid turned by `yaw` radians about the world's y axis (counter-clockwise from above), then moved.
Solid placed(Solid solid, double yaw, const glm::dvec3& offset);

/// Axis-aligned bounds.
struct Bounds {
  glm::dvec3 low, high;
};
Bounds bounds_of(const Solid& solid);

/// A body with `cuts` taken away: a wall with an arch, a sphere hollowed to a bowl.
struct Object {
  Solid body;
  std::vector<Solid> cuts;
  glm::vec3 albedo{0.5f};
  Bounds bounds;
};

struct Scene {
  std::vector<Object> objects;
  void add(const Solid& body, const glm::vec3& albedo, const std::vector<Solid>& cuts = {});
};

struct Hit {
  double distance = 0;
  glm::dvec3 normal{0.0};  ///< outward from the object, unit, against the ray
  const Object* object = nullptr;
};

/// The first surface in front of the ray's origin.
std::optional<Hit> first_hit(const Scene& scene, const Ray& ray);

/// Whether a surface lies on the ray nearer than `reach`.
bool blocked(const Scene& scene, const Ray& ray, double reach);

/// Visibility at a point.
struct Visibility {
  double ao = 1;               ///< 1 open, 0 closed: mean of the two halves
  double half_difference = 0;  ///< first half minus second, for estimating the noise
};

/// Cosine-weighted share of the hemisphere about `normal` in which nothing is nearer than `radius`; binary, without falloff.
/// `samples` rays in two halves, two independent randomisations of one low-discrepancy set, so that the variance of `ao` is that
/// of `half_difference` divided by four.
Visibility ambient_visibility(const Scene& scene, const glm::dvec3& point, const glm::dvec3& normal, double radius,
                              int samples, uint32_t seed);

}  // namespace gloam::analytic
