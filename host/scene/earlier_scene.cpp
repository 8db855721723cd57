#include "scene/earlier_scene.h"

#include <cstddef>
#include <glm/geometric.hpp>

#include "gloam/error.h"

namespace gloam {
namespace {

using glm::dvec3;

/// Weights of a triangle's corners, whose sum is 1, for a point in its plane.
dvec3 weights_at(const dvec3 (&corners)[3], const dvec3& point) {
  const dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], p = point - corners[0];
  const dvec3 normal = glm::cross(u, v);
  const double area = glm::dot(normal, normal);
  if (area == 0) return {1, 0, 0};
  const double b = glm::dot(glm::cross(p, v), normal) / area, c = glm::dot(glm::cross(u, p), normal) / area;
  return {1 - b - c, b, c};
}

}  // namespace

void check_earlier_scene(const Scene& now, const Scene& before) {
  if (now.meshes.size() != before.meshes.size())
    throw UsageError("the scene has {} meshes, and the one of the frame before {}; for motion both need the same ones",
                     now.meshes.size(), before.meshes.size());
  for (size_t i = 0; i < now.meshes.size(); ++i) {
    const Mesh &mesh = now.meshes[i], &earlier = before.meshes[i];
    if (mesh.triangles == earlier.triangles && mesh.positions.size() == earlier.positions.size()) continue;
    throw UsageError(
        "mesh '{}' has other triangles than in the scene of the frame before; for motion only vertices may move",
        mesh.name);
  }
}

dvec3 earlier_position(const Scene& now, const Scene& before, const Surface& surface) {
  const Mesh &mesh = now.meshes[size_t(surface.mesh)], &moved = before.meshes[size_t(surface.mesh)];
  const glm::uvec3& triangle = mesh.triangles[surface.triangle];
  dvec3 corners[3], earlier[3];
  bool has_moved = now.origin != before.origin;
  for (int i = 0; i < 3; ++i) {
    corners[i] = mesh.positions[triangle[i]];
    earlier[i] = moved.positions[triangle[i]];
    has_moved |= corners[i] != earlier[i];
  }
  if (!has_moved) return surface.position + now.origin;
  const dvec3 weights = weights_at(corners, surface.position);
  return weights.x * earlier[0] + weights.y * earlier[1] + weights.z * earlier[2] + before.origin;
}

}  // namespace gloam
