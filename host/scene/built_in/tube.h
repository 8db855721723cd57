// Tubes along curves, and bent blades: for hair, wires, branches and leaves.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "scene/built_in/mesh_builder.h"

namespace gloam::scenes {

/// A unit vector at a right angle to a unit vector.
inline vec3 perpendicular(vec3 axis) {
  return glm::normalize(glm::cross(std::abs(axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), axis));
}

/// A number in [low, high) that depends only on its other arguments.
inline float random_in(float low, float high, uint32_t a, uint32_t b = 0, uint32_t c = 0) {
  return low + (high - low) * hash01(a, b, c);
}

/// A point on the unit sphere that depends only on its arguments.
inline vec3 random_direction(uint32_t a, uint32_t b = 0) {
  const float y = random_in(-1, 1, a, b, 101), angle = random_in(0, glm::two_pi<float>(), a, b, 102);
  const float across = std::sqrt(1 - y * y);
  return {across * std::cos(angle), y, across * std::sin(angle)};
}

/// A closed tube along at least two points, none equal to the next, with a radius at each; both ends are pointed by one
/// radius. Smooth, outward, every edge shared by two triangles: 2 * sides * points.size() of them.
inline void add_tube(Mesh& mesh, const std::vector<vec3>& points, const std::vector<float>& radii, int sides) {
  const size_t n = points.size();
  const auto along = [&](size_t i) {
    return glm::normalize(points[std::min(i + 1, n - 1)] - points[i == 0 ? 0 : i - 1]);
  };
  const auto add_vertex = [&](vec3 position, vec3 normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    return unsigned(mesh.positions.size() - 1);
  };
  const unsigned count = unsigned(sides);
  const unsigned start = add_vertex(points[0] - radii[0] * along(0), -along(0));
  vec3 x = perpendicular(along(0));
  for (size_t i = 0; i < n; ++i) {
    // The frame is carried along: only the part of x at a right angle to the new tangent is kept, so it does not twist.
    const vec3 tangent = along(i);
    x = glm::normalize(x - glm::dot(x, tangent) * tangent);
    const vec3 y = glm::cross(tangent, x);
    for (int side = 0; side < sides; ++side) {
      const float angle = glm::two_pi<float>() * float(side) / float(sides);
      const vec3 out = std::cos(angle) * x + std::sin(angle) * y;
      add_vertex(points[i] + radii[i] * out, out);
    }
  }
  const unsigned end = add_vertex(points[n - 1] + radii[n - 1] * along(n - 1), along(n - 1));
  const unsigned last = end - count;
  for (unsigned side = 0; side < count; ++side) {
    const unsigned next = (side + 1) % count;
    mesh.triangles.push_back({start, start + 1 + next, start + 1 + side});
    for (unsigned ring = start + 1; ring < last; ring += count) {
      mesh.triangles.push_back({ring + side, ring + next, ring + count + next});
      mesh.triangles.push_back({ring + side, ring + count + next, ring + count + side});
    }
    mesh.triangles.push_back({last + side, last + next, end});
  }
}

/// A tube of one radius.
inline void add_tube(Mesh& mesh, const std::vector<vec3>& points, float radius, int sides) {
  add_tube(mesh, points, std::vector<float>(points.size(), radius), sides);
}

/// A blade of grass or a frond's leaf: one-sided strip from `root`, leaning along `lean` (horizontal, not unit) at its
/// tip, ending in a point: 2 * segments - 1 triangles.
inline void add_blade(Mesh& mesh, vec3 root, vec3 lean, float height, float width, int segments = 3) {
  const vec3 across = glm::normalize(glm::cross(vec3(0, 1, 0), lean)) * (width / 2);
  const unsigned first = unsigned(mesh.positions.size());
  for (int i = 0; i <= segments; ++i) {
    const float t = float(i) / float(segments);
    const vec3 middle = root + vec3(0, height * (t - 0.25f * t * t), 0) + lean * (t * t);
    const vec3 tangent = vec3(0, height * (1 - 0.5f * t), 0) + lean * (2 * t);
    const vec3 normal = glm::normalize(glm::cross(across, tangent));
    const vec3 half = across * (1 - t);
    for (int side = 0; side < (i < segments ? 2 : 1); ++side) {
      mesh.positions.push_back(i < segments ? middle + (side ? half : -half) : middle);
      mesh.normals.push_back(normal);
    }
  }
  for (unsigned i = 0; i < unsigned(segments); ++i) {
    const unsigned a = first + 2 * i;
    mesh.triangles.push_back({a, a + 1, a + 2});
    if (int(i) + 1 < segments) mesh.triangles.push_back({a + 1, a + 3, a + 2});
  }
}

}  // namespace gloam::scenes
