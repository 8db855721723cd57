// A draped standing figure in a niche, at a chosen number of faces: a smooth organic surface.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <unordered_map>

#include "scene/built_in/mesh_builder.h"
#include "scene/built_in/tube.h"

namespace gloam::scenes {
namespace {

constexpr float pi = glm::pi<float>();

// --- The figure as a signed distance (approximate).
// Feet at y = 0, facing +z.

float smooth_union(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * k * 0.25f;
}
float smooth_cut(float a, float b, float k) { return -smooth_union(-a, b, k); }

float ellipsoid(vec3 p, vec3 centre, vec3 radii) {
  const vec3 q = (p - centre) / radii;
  const float k0 = glm::length(q), k1 = glm::length(q / radii);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}
float sphere(vec3 p, vec3 centre, float radius) { return glm::length(p - centre) - radius; }

/// A capsule whose radius goes from `from` to `to`.
float limb(vec3 p, vec3 a, vec3 b, float from, float to) {
  const vec3 ab = b - a;
  const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
  return glm::length(p - a - t * ab) - glm::mix(from, to, t);
}

float head(vec3 p) {
  const vec3 mirrored(std::abs(p.x), p.y, p.z);
  float d = ellipsoid(p, {0, 1.6f, 0.02f}, {0.074f, 0.105f, 0.09f});
  d = smooth_union(d, ellipsoid(p, {0, 1.545f, 0.042f}, {0.053f, 0.06f, 0.058f}), 0.03f);
  d = smooth_union(d, limb(mirrored, {0, 1.622f, 0.1f}, {0.04f, 1.627f, 0.085f}, 0.011f, 0.009f), 0.02f);  // brow
  d = smooth_cut(d, sphere(mirrored, {0.031f, 1.603f, 0.118f}, 0.02f), 0.014f);                            // socket
  d = smooth_union(d, ellipsoid(mirrored, {0.03f, 1.602f, 0.095f}, {0.0155f, 0.011f, 0.011f}), 0.004f);    // eye
  d = smooth_union(d, limb(p, {0, 1.622f, 0.103f}, {0, 1.58f, 0.122f}, 0.008f, 0.012f), 0.012f);           // nose
  d = smooth_union(d, sphere(mirrored, {0.01f, 1.578f, 0.112f}, 0.008f), 0.008f);
  d = smooth_union(d, limb(mirrored, {0, 1.555f, 0.111f}, {0.023f, 1.551f, 0.099f}, 0.0075f, 0.004f), 0.006f);  // lips
  d = smooth_union(d, limb(mirrored, {0, 1.538f, 0.108f}, {0.019f, 1.542f, 0.098f}, 0.0085f, 0.004f), 0.006f);
  d = smooth_cut(d, limb(mirrored, {0, 1.5465f, 0.121f}, {0.022f, 1.547f, 0.108f}, 0.004f, 0.003f), 0.004f);
  d = smooth_union(d, sphere(p, {0, 1.507f, 0.082f}, 0.018f), 0.025f);                                // chin
  d = smooth_union(d, sphere(mirrored, {0.045f, 1.57f, 0.065f}, 0.022f), 0.03f);                      // cheek
  d = smooth_union(d, ellipsoid(mirrored, {0.076f, 1.585f, 0.01f}, {0.01f, 0.028f, 0.017f}), 0.01f);  // ear
  return d;
}

float hair(vec3 p) {
  const float angle = std::atan2(p.x, p.z + 0.02f);
  const float waves = 0.0035f * std::sin(16 * angle + 9 * std::sin(30 * p.y)) + 0.002f * std::sin(70 * p.y + 5 * angle);
  float d = ellipsoid(p, {0, 1.63f, -0.014f}, {0.09f, 0.098f, 0.1f});
  d = smooth_cut(d, ellipsoid(p, {0, 1.585f, 0.11f}, {0.066f, 0.095f, 0.07f}), 0.02f);  // frames the face
  d = smooth_union(d, ellipsoid(p, {0, 1.63f, -0.125f}, {0.05f, 0.045f, 0.045f}), 0.02f);
  // A braid from the neck over the shoulder.
  d = smooth_union(d, limb(p, {0.05f, 1.53f, -0.04f}, {0.085f, 1.42f, 0.03f}, 0.022f, 0.018f), 0.02f);
  d = smooth_union(d, limb(p, {0.085f, 1.42f, 0.03f}, {0.08f, 1.29f, 0.115f}, 0.018f, 0.011f), 0.012f);
  return d + waves;
}

/// Cloth folds around the body: ridges of uneven width that deepen towards the hem.
float folds(vec3 p, float angle) {
  const float bent = angle + 0.1f * std::sin(3 * angle + 1) + 0.06f * std::sin(2.5f * p.y + 2 * angle);
  const float deep = std::clamp((1.05f - p.y) / 0.9f, 0.0f, 1.0f);
  const float ridge = std::cos(15 * bent + 1.2f * std::sin(3 * p.y)), fine = std::sin(31 * bent + 4 * p.y);
  return deep * (0.014f * ridge + 0.004f * fine * ridge + 0.003f * fine);
}

float skirt(vec3 p) {
  const vec3 q(p.x, p.y, p.z * 1.22f);
  const float t = std::clamp((0.98f - p.y) / 0.93f, 0.0f, 1.0f);
  const vec3 axis(0.012f + 0.03f * std::sin(2.2f * t), p.y, 0.015f * t);
  const float radius = glm::mix(0.165f, 0.27f, t * t * (1.6f - 0.6f * t));
  const vec3 away = q - axis;
  const float side = std::sqrt(away.x * away.x + away.z * away.z) - radius - folds(p, std::atan2(away.x, away.z));
  return 0.8f * smooth_cut(smooth_cut(side, p.y - 0.035f, 0.02f), 1.02f - p.y, 0.06f);
}

/// The mantle: rolls of cloth slung from the left shoulder to the right hip, around the back.
float mantle(vec3 p) {
  const vec3 centre(0.0f, 1.16f, 0.0f), along = glm::normalize(vec3(0.42f, 0.62f, 0));
  const vec3 across = glm::normalize(vec3(0.62f, -0.42f, 0));
  const float angle = std::atan2(p.z / 0.165f, glm::dot(p - centre, along) / 0.28f);
  float d = 1e9f;
  for (int roll = 0; roll < 5; ++roll) {
    const float at = 0.045f * (float(roll) - 2), long_half = 0.285f - 0.008f * float(roll * roll % 3);
    const vec3 q = p - centre - at * across;
    const float u = glm::dot(q, along) / long_half, w = q.z / 0.165f, ring = std::sqrt(u * u + w * w);
    const float to_ring =
        (ring - 1) * (ring > 0 ? glm::length(vec2(u, w)) / glm::length(vec2(u / long_half, w / 0.165f)) : 0.1f);
    const float wave = 0.012f * std::sin(5 * angle + 1.7f * float(roll));
    const float off = glm::dot(q, across) + wave;
    d = smooth_union(d, std::sqrt(to_ring * to_ring + off * off) - 0.029f, 0.024f);
  }
  // Its end hangs over the left forearm.
  for (int strip = 0; strip < 4; ++strip) {
    const float x = 0.2f + 0.035f * float(strip), z = 0.1f - 0.04f * float(strip % 2);
    const float hem = 0.5f - 0.05f * float(strip % 3);
    d = smooth_union(d, limb(p, {x, 1.12f, z}, {x + 0.04f, hem, z + 0.02f}, 0.022f, 0.032f), 0.03f);
  }
  return d;
}

float arm(vec3 p, vec3 shoulder, vec3 elbow, vec3 wrist) {
  float d = limb(p, shoulder, elbow, 0.058f, 0.043f);
  d = smooth_union(d, limb(p, elbow, wrist, 0.044f, 0.029f), 0.03f);
  return smooth_union(d, limb(p, shoulder, glm::mix(shoulder, elbow, 0.55f), 0.066f, 0.058f), 0.02f);  // sleeve
}

/// A palm and four fingers that point along `along`, thumb towards `thumb`; both unit.
float hand(vec3 p, vec3 wrist, vec3 along, vec3 thumb) {
  float d = limb(p, wrist, wrist + 0.06f * along, 0.026f, 0.03f);
  for (int finger = 0; finger < 4; ++finger) {
    const vec3 root = wrist + 0.075f * along + (0.027f - 0.018f * float(finger)) * thumb;
    d = smooth_union(d, limb(p, root, root + 0.07f * along - 0.012f * float(finger) * thumb, 0.0115f, 0.008f), 0.012f);
  }
  const vec3 root = wrist + 0.03f * along + 0.025f * thumb;
  return smooth_union(d, limb(p, root, root + 0.05f * along + 0.035f * thumb, 0.013f, 0.0095f), 0.012f);
}

float torso(vec3 p) {
  const vec3 mirrored(std::abs(p.x), p.y, p.z);
  float d = ellipsoid(p, {0, 1.25f, 0}, {0.16f, 0.19f, 0.108f});
  d = smooth_union(d, limb(mirrored, {0, 1.385f, -0.012f}, {0.165f, 1.372f, -0.012f}, 0.062f, 0.058f), 0.07f);
  d = smooth_union(d, sphere(mirrored, {0.074f, 1.262f, 0.07f}, 0.062f), 0.05f);
  d = smooth_union(d, ellipsoid(p, {0, 1.06f, 0}, {0.132f, 0.16f, 0.098f}), 0.06f);
  d = smooth_union(d, ellipsoid(p, {0.015f, 0.94f, 0}, {0.178f, 0.13f, 0.128f}), 0.06f);
  // The dress: folds that fall from the shoulders and meet between them, and a girdle.
  const float fall =
      0.006f * std::sin(95 * mirrored.x + 26 * std::abs(p.y - 1.42f)) * std::clamp((p.z + 0.05f) / 0.08f, 0.0f, 1.0f);
  d -= fall;
  const float waist = std::sqrt(p.x * p.x * 0.6f + p.z * p.z) - 0.112f, level = p.y - 1.105f - 0.02f * p.x;
  return smooth_union(d, std::sqrt(waist * waist + level * level) - 0.016f, 0.012f);
}

/// Whether a part inside a box can change a union that is `d` so far, blended over `k`.
bool matters(vec3 p, vec3 low, vec3 high, float d, float k) {
  const vec3 outside = glm::max(glm::max(low - p, p - high), vec3(0));
  return glm::dot(outside, outside) < (std::max(d, 0.0f) + k) * (std::max(d, 0.0f) + k);
}

float right_arm(vec3 p) {
  const float d = arm(p, {-0.2f, 1.365f, -0.012f}, {-0.285f, 1.1f, -0.03f}, {-0.3f, 0.87f, 0.09f});
  const vec3 along = glm::normalize(vec3(0.02f, -0.93f, 0.35f));
  return smooth_union(d, hand(p, {-0.3f, 0.86f, 0.095f}, along, {0, 0.35f, 0.93f}), 0.012f);
}

/// With the scroll that it holds.
float left_arm(vec3 p) {
  float d = arm(p, {0.2f, 1.365f, -0.012f}, {0.275f, 1.12f, 0.0f}, {0.13f, 1.13f, 0.2f});
  d = smooth_union(d, hand(p, {0.125f, 1.135f, 0.205f}, glm::normalize(vec3(-0.85f, 0.2f, 0.3f)), {0, 1, 0}), 0.012f);
  return smooth_union(d, limb(p, {0.045f, 1.02f, 0.222f}, {0.03f, 1.28f, 0.2f}, 0.024f, 0.024f), 0.005f);
}

/// Feet, and the plinth of the same block: a flat rounded cylinder.
float base(vec3 p) {
  const vec2 from_rim(std::sqrt(p.x * p.x + p.z * p.z) - 0.35f, std::abs(p.y) - 0.025f);
  float d = glm::length(glm::max(from_rim, vec2(0))) + std::min(std::max(from_rim.x, from_rim.y), 0.0f) - 0.015f;
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 foot(side > 0 ? 0.1f : -0.085f, 0.04f, side > 0 ? 0.235f : 0.19f);
    d = smooth_union(d, ellipsoid(p, foot, {0.042f, 0.03f, 0.075f}), 0.015f);
  }
  return d;
}

/// Parts that are too far to matter are not computed.
float figure(const vec3& p) {
  float d = base(p);
  if (matters(p, {-0.33f, 0.0f, -0.27f}, {0.33f, 1.04f, 0.27f}, d, 0.02f)) d = smooth_union(d, skirt(p), 0.015f);
  if (matters(p, {-0.24f, 0.78f, -0.14f}, {0.24f, 1.47f, 0.15f}, d, 0.06f)) d = smooth_union(d, torso(p), 0.05f);
  d = smooth_union(d, limb(p, {0.075f, 0.8f, 0.07f}, {0.09f, 0.52f, 0.15f}, 0.09f, 0.075f), 0.07f);  // knee
  if (matters(p, {-0.33f, 0.35f, -0.22f}, {0.38f, 1.5f, 0.22f}, d, 0.03f)) d = smooth_union(d, mantle(p), 0.012f);
  if (matters(p, {-0.15f, 1.25f, -0.2f}, {0.15f, 1.76f, 0.16f}, d, 0.04f)) {
    float upper = smooth_union(head(p), limb(p, {0, 1.38f, -0.01f}, {0, 1.53f, 0.005f}, 0.054f, 0.047f), 0.03f);
    upper = smooth_union(upper, hair(p), 0.008f);
    d = smooth_union(d, upper, 0.025f);
  }
  if (matters(p, {-0.37f, 0.66f, -0.1f}, {-0.12f, 1.45f, 0.19f}, d, 0.03f)) d = smooth_union(d, right_arm(p), 0.025f);
  if (matters(p, {-0.05f, 0.98f, -0.1f}, {0.35f, 1.45f, 0.3f}, d, 0.03f)) d = smooth_union(d, left_arm(p), 0.02f);
  return d;
}

// --- From distance to triangles: marching tetrahedra (six per cube, about its diagonal), which is closed and manifold by
// construction, and vertices evened out along the surface.

/// Cubes of a grid; points have indices from 0 to `counts` along each axis.
struct Grid {
  vec3 low{-0.52f, -0.12f, -0.47f}, high{0.52f, 1.86f, 0.47f};
  float step;
  glm::ivec3 counts;
  explicit Grid(float s) : step(s), counts(glm::ceil((high - low) / s)) {}
  vec3 at(glm::ivec3 i) const { return low + step * vec3(i); }
  uint64_t index(glm::ivec3 i) const {
    return (uint64_t(i.z) * uint64_t(counts.y + 1) + uint64_t(i.y)) * uint64_t(counts.x + 1) + uint64_t(i.x);
  }
};

class Polygoniser {
 public:
  Polygoniser(const Grid& grid, Mesh& mesh) : grid_(grid), mesh_(mesh) {}

  void run() {
    for (int z = 0; z < grid_.counts.z; z += block)
      for (int y = 0; y < grid_.counts.y; y += block)
        for (int x = 0; x < grid_.counts.x; x += block) add_block({x, y, z});
  }

 private:
  static constexpr int block = 6, row = block + 1;

  /// A block of cubes, unless it is so far from the surface that none crosses it.
  void add_block(glm::ivec3 first) {
    const float half = 0.5f * block * grid_.step, steepness = 1.7f;
    if (std::abs(figure(grid_.at(first) + half)) > steepness * std::sqrt(3.0f) * half) return;
    for (int z = 0; z < row; ++z)
      for (int y = 0; y < row; ++y)
        for (int x = 0; x < row; ++x)
          values_[size_t((z * row + y) * row + x)] = figure(grid_.at(first + glm::ivec3(x, y, z)));
    for (int z = 0; z < std::min(block, grid_.counts.z - first.z); ++z)
      for (int y = 0; y < std::min(block, grid_.counts.y - first.y); ++y)
        for (int x = 0; x < std::min(block, grid_.counts.x - first.x); ++x) add_cube(first, {x, y, z});
  }

  float value(glm::ivec3 p) const { return values_[size_t((p.z * row + p.y) * row + p.x)]; }
  static glm::ivec3 corner(int bits) { return {bits & 1, bits >> 1 & 1, bits >> 2}; }

  void add_cube(glm::ivec3 first, glm::ivec3 cube) {
    first_ = first;
    cube_ = cube;
    int inside = 0;
    for (int bits = 0; bits < 8; ++bits) {
      corners_[size_t(bits)] = value(cube + corner(bits));
      inside += corners_[size_t(bits)] < 0;
    }
    if (inside == 0 || inside == 8) return;
    // Paths from corner 0 to corner 7 along the axes in every order; odd orders make mirrored tetrahedra.
    constexpr int paths[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 2, 3, 7}, {0, 1, 5, 7}, {0, 4, 6, 7}};
    for (int i = 0; i < 6; ++i) add_tetrahedron(paths[i], i >= 3);
  }

  void add_tetrahedron(const int (&path)[4], bool mirrored) {
    // Even orders of the four corners, by the set of those inside (bit i: corner i).
    constexpr int orders[16][4] = {
        {},           {0, 1, 2, 3}, {1, 0, 3, 2}, {0, 1, 2, 3}, {2, 0, 1, 3}, {0, 2, 3, 1}, {1, 2, 0, 3}, {3, 0, 2, 1},
        {3, 0, 2, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}, {2, 0, 1, 3}, {2, 3, 0, 1}, {1, 0, 3, 2}, {0, 1, 2, 3}, {}};
    int set = 0;
    for (int i = 0; i < 4; ++i) set |= (corners_[size_t(path[i])] < 0) << i;
    if (set == 0 || set == 15) return;
    const int* order = orders[set];
    const int a = path[order[0]], b = path[order[1]], c = path[order[2]], d = path[order[3]];
    const int count = __builtin_popcount(unsigned(set));
    if (count == 2) {
      const unsigned ac = vertex(a, c), ad = vertex(a, d), bd = vertex(b, d), bc = vertex(b, c);
      add_triangle(ac, ad, bd, mirrored);
      add_triangle(ac, bd, bc, mirrored);
    } else {
      add_triangle(vertex(a, b), vertex(a, c), vertex(a, d), mirrored != (count == 3));
    }
  }

  void add_triangle(unsigned a, unsigned b, unsigned c, bool turned_round) {
    mesh_.triangles.push_back(turned_round ? glm::uvec3(a, c, b) : glm::uvec3(a, b, c));
  }

  /// Where the surface crosses the edge between two corners; shared by all cubes around it.
  unsigned vertex(int a, int b) {
    if (a > b) std::swap(a, b);
    const glm::ivec3 low = first_ + cube_ + corner(a);
    const auto [found, is_new] =
        vertices_.try_emplace(grid_.index(low) * 8 + uint64_t(a ^ b), unsigned(mesh_.positions.size()));
    if (is_new) {
      const float va = corners_[size_t(a)], vb = corners_[size_t(b)];
      const float t = std::clamp(va / (va - vb), 0.02f, 0.98f);
      mesh_.positions.push_back(glm::mix(grid_.at(low), grid_.at(first_ + cube_ + corner(b)), t));
    }
    return found->second;
  }

  const Grid& grid_;
  Mesh& mesh_;
  std::array<float, row * row * row> values_;
  std::array<float, 8> corners_;
  glm::ivec3 first_, cube_;
  std::unordered_map<uint64_t, unsigned> vertices_;
};

/// Puts every vertex in the middle of its neighbours and back on the surface, some times, for triangles of even shape.
void relax(Mesh& mesh, float step) {
  const long count = long(mesh.positions.size());
  for (int pass = 0; pass < 4; ++pass) {
    if (pass < 3) {
      std::vector<vec3> sums(mesh.positions.size(), vec3(0));
      std::vector<float> counts(mesh.positions.size(), 0);
      for (const glm::uvec3 t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
          const unsigned v = t[i];
          sums[v] += mesh.positions[t[(i + 1) % 3]] + mesh.positions[t[(i + 2) % 3]];
          counts[v] += 2;
        }
      }
      for (size_t i = 0; i < sums.size(); ++i)
        mesh.positions[i] = glm::mix(mesh.positions[i], sums[i] / counts[i], 0.6f);
    }
#pragma omp parallel for schedule(static, 1024)
    for (long i = 0; i < count; ++i) {
      vec3& p = mesh.positions[size_t(i)];
      const float here = figure(p), h = 0.05f * step;
      const vec3 ahead(figure(p + vec3(h, 0, 0)), figure(p + vec3(0, h, 0)), figure(p + vec3(0, 0, h)));
      const vec3 slope = (ahead - here) / h;
      const float distance = here / std::max(glm::dot(slope, slope), 0.25f);
      p -= std::clamp(distance, -0.3f * step, 0.3f * step) * slope;
    }
  }
}

/// The mean of the triangles around each vertex, by area: right at every number of faces.
void add_normals(Mesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), vec3(0));
  for (const glm::uvec3 t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    for (int i = 0; i < 3; ++i) mesh.normals[t[i]] += glm::cross(b - a, c - a);
  }
  for (vec3& n : mesh.normals) n = glm::length(n) > 0 ? glm::normalize(n) : vec3(0, 1, 0);
}

/// Leaves out what a coarse grid cuts off (a finger tip) and hollows inside: only the part with most vertices stays.
Mesh largest_part(const Mesh& mesh) {
  std::vector<unsigned> parent(mesh.positions.size()), sizes(mesh.positions.size(), 0);
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = unsigned(i);
  const auto root = [&](unsigned i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const glm::uvec3 t : mesh.triangles) {
    parent[root(t.x)] = root(t.y);
    parent[root(t.z)] = root(t.y);
  }
  for (size_t i = 0; i < parent.size(); ++i) ++sizes[root(unsigned(i))];
  const unsigned largest = unsigned(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  Mesh kept;
  std::vector<unsigned> places(mesh.positions.size());
  for (size_t i = 0; i < places.size(); ++i) {
    places[i] = unsigned(kept.positions.size());
    if (root(unsigned(i)) == largest) kept.positions.push_back(mesh.positions[i]);
  }
  for (const glm::uvec3 t : mesh.triangles) {
    if (root(t.x) == largest) kept.triangles.push_back({places[t.x], places[t.y], places[t.z]});
  }
  return kept;
}

Mesh polygonised(float step) {
  Mesh mesh;
  const Grid grid(step);
  Polygoniser(grid, mesh).run();
  return largest_part(mesh);
}

/// The figure with about `faces` triangles (within 3 % from some thousand on): the number goes with the inverse square
/// of the grid's step.
Mesh figure_with(double faces) {
  double step = 0.06, goal = std::min(faces, 20000.0);
  Mesh mesh;
  for (int attempt = 0; attempt < 8; ++attempt) {
    mesh = polygonised(float(step));
    const double ratio = double(mesh.triangles.size()) / goal;
    if (goal == faces && std::abs(ratio - 1) < 0.03) break;
    if (std::abs(ratio - 1) < 0.03) goal = faces;
    step *= std::sqrt(double(mesh.triangles.size()) / goal);
  }
  relax(mesh, float(step));
  add_normals(mesh);
  return mesh;
}

// --- What stands around it. `detail` is 1 at the default number of faces.

constexpr float niche_radius = 0.8f, sill = 0.3f, springing = 2.4f;

int scaled(float count, float detail, int least) { return std::max(least, int(std::lround(count * detail))); }

/// The arch's outline, from the left foot over the top to the right foot, at a distance from its edge.
vec2 arch(float u, float away) {
  const float radius = niche_radius + away, jamb = springing - sill, whole = 2 * jamb + pi * niche_radius;
  const float s = u * whole;
  if (s < jamb) return {-radius, sill + s};
  if (s > whole - jamb) return {radius, sill + whole - s};
  const float angle = pi - (s - jamb) / niche_radius;
  return {radius * std::cos(angle), springing + radius * std::sin(angle)};
}

/// The wall's own outline, point by point outside the arch's.
vec2 wall_edge(float u) {
  const float half = 4.2f, top = 4.4f;
  const vec2 p = arch(u, 0), centre(0, springing);
  if (p.y <= springing) return {p.x < 0 ? -half : half, sill + (p.y - sill)};
  const vec2 out = p - centre;
  const float reach = std::min(half / std::max(std::abs(out.x), 1e-4f), (top - springing) / std::max(out.y, 1e-4f));
  return centre + reach * out;
}

void add_pilaster(Mesh& mesh, float x, float detail) {
  add_box(mesh, {x - 0.24f, 0, 0}, {x + 0.24f, 0.35f, 0.28f});
  add_box(mesh, {x - 0.21f, 0.35f, 0}, {x + 0.21f, 0.43f, 0.25f});
  add_surface(
      mesh,
      [&](float u, float v) {
        const float angle = pi * (u - 0.5f), flutes = 0.012f * std::abs(std::cos(9 * angle));
        const float radius = 0.17f - 0.02f * v + flutes;
        return vec3(x + radius * std::sin(angle), glm::mix(0.43f, 3.3f, v), 0.02f + radius * std::cos(angle));
      },
      scaled(72, detail, 6), scaled(12, detail, 1));
  add_box(mesh, {x - 0.19f, 3.3f, 0}, {x + 0.19f, 3.4f, 0.23f});
  add_box(mesh, {x - 0.24f, 3.4f, 0}, {x + 0.24f, 3.5f, 0.28f});
}

void add_urn(Scene& scene, const std::string& name, int stone, int bronze, float x, float detail) {
  Mesh& block = add_mesh(scene, name + " plinth", stone);
  add_box(block, {x - 0.3f, 0, 0.2f}, {x + 0.3f, 0.7f, 0.8f});
  add_box(block, {x - 0.34f, 0.7f, 0.16f}, {x + 0.34f, 0.78f, 0.84f});
  std::vector<vec2> profile;
  const int rows = scaled(60, detail, 6);
  for (int i = 0; i <= rows; ++i) {
    const float t = float(i) / float(rows);
    const float belly = 0.23f * std::pow(std::sin(pi * std::pow(t, 0.75f) * 0.93f + 0.1f), 2.0f);
    profile.push_back(
        {i == 0 ? 0 : 0.07f + belly + 0.05f * std::exp(-60 * t * t) + 0.06f * std::pow(t, 12.0f), 0.75f * t});
  }
  profile.push_back({0.12f, 0.74f});
  profile.push_back({0.09f, 0.6f});
  profile.push_back({0, 0.58f});
  add_lathe(add_mesh(scene, name, bronze), {x, 0.78f, 0.5f}, profile, scaled(64, detail, 6));
}

void add_floor(Scene& scene, int light, int dark, float detail) {
  const int across = scaled(14, detail, 2), along = scaled(10, detail, 2);
  Mesh light_tiles{.name = "light tiles", .material = light}, dark_tiles{.name = "dark tiles", .material = dark};
  const vec3 size(14.0f / float(across), 0, 10.0f / float(along));
  for (int z = 0; z < along; ++z) {
    for (int x = 0; x < across; ++x) {
      const vec3 a(-7 + size.x * float(x), 0, 8 - size.z * float(z)), right(size.x, 0, 0), back(0, 0, -size.z);
      add_quad((x + z) % 2 ? dark_tiles : light_tiles, a, a + right, a + right + back, a + back);
    }
  }
  scene.meshes.push_back(std::move(light_tiles));
  scene.meshes.push_back(std::move(dark_tiles));
}

void add_pedestal(Mesh& mesh, float detail) {
  add_box(mesh, {-0.5f, sill, -0.5f}, {0.5f, sill + 0.1f, 0.5f});
  add_lathe(mesh, {0, sill + 0.1f, 0},
            {{0.47f, 0},
             {0.47f, 0.05f},
             {0.47f, 0.05f},
             {0.42f, 0.09f},
             {0.39f, 0.13f},
             {0.39f, 0.13f},
             {0.38f, 0.44f},
             {0.38f, 0.44f},
             {0.41f, 0.48f},
             {0.45f, 0.5f},
             {0.45f, 0.5f},
             {0.45f, 0.56f},
             {0.45f, 0.56f},
             {0, 0.56f}},
            scaled(96, detail, 6));
}

void add_front(Scene& scene, int plaster, int stone, int marble, float detail) {
  add_surface(
      add_mesh(scene, "wall", plaster), [](float u, float v) { return vec3(glm::mix(arch(u, 0), wall_edge(u), v), 0); },
      scaled(120, detail, 12), scaled(16, detail, 1));
  Mesh& archivolt = add_mesh(scene, "archivolt", marble);
  add_surface(
      archivolt,
      [](float u, float v) {  // a moulding: hollow, roll and edge
        const float out =
            0.05f * std::sqrt(std::abs(std::sin(3 * pi * v))) * (1 - 0.4f * v) + (v > 0 && v < 1 ? 0.02f : 0);
        return vec3(arch(u, 0.2f * v), out);
      },
      scaled(120, detail, 12), scaled(30, detail, 2));
  Mesh& key = add_mesh(scene, "keystone", marble);
  add_extrusion(key, {{-0.07f, 3.14f}, {0.07f, 3.14f}, {0.12f, 3.5f}, {-0.12f, 3.5f}}, 0, 0.13f);
  Mesh& step = add_mesh(scene, "sill", stone);
  add_box(step, {-4.2f, 0, -0.05f}, {4.2f, sill, 0.02f});
  add_box(step, {-1.0f, 0, 0.02f}, {1.0f, 0.15f, 0.9f});
  add_box(step, {-0.86f, 0.15f, 0.02f}, {0.86f, sill, 0.62f});
  for (const float side : {-1.0f, 1.0f})
    add_pilaster(add_mesh(scene, side < 0 ? "left pilaster" : "right pilaster", marble), 1.42f * side, detail);
  Mesh& cornice = add_mesh(scene, "cornice", stone);
  add_box(cornice, {-4.2f, 3.5f, 0}, {4.2f, 3.72f, 0.2f});
  add_box(cornice, {-4.2f, 3.86f, 0}, {4.2f, 3.98f, 0.42f});
  const int dentils = scaled(40, detail, 3);
  for (int i = 0; i < dentils; ++i) {
    const float pitch = 8.4f / float(dentils), x = -4.2f + pitch * (float(i) + 0.5f);
    add_box(cornice, {x - 0.3f * pitch, 3.72f, 0}, {x + 0.3f * pitch, 3.86f, 0.33f});
  }
}

/// The niche, half a cylinder under a quarter of a sphere: as many faces as are left.
void add_niche(Mesh& mesh, double faces) {
  const int columns = std::max(4, int(std::sqrt(faces / 2 * 0.75)));
  const int rows = std::max(3, int(std::lround(faces / 2 / columns)));
  add_surface(
      mesh,
      [](float u, float v) {
        const float jamb = springing - sill, whole = jamb + pi / 2 * niche_radius, s = v * whole;
        const float polar = s < jamb ? 0 : std::min((s - jamb) / niche_radius, 0.499f * pi), angle = pi * (u - 0.5f);
        const float radius = niche_radius * std::cos(polar);
        return vec3(radius * std::sin(angle), sill + std::min(s, jamb) + niche_radius * std::sin(polar),
                    -radius * std::cos(angle));
      },
      columns, rows);
}

Scene make(const ParameterValues& values) {
  Scene scene;
  const double faces = values.number("faces");
  const float detail = std::clamp(float(std::sqrt(faces / 200000)), 0.07f, 2.5f);
  const int marble = add_material(scene, "white marble", {0.72f, 0.7f, 0.66f}, 0.35f);
  const int stone = add_material(scene, "limestone", {0.58f, 0.53f, 0.44f}, 0.85f);
  const int grey = add_material(scene, "grey marble", {0.42f, 0.42f, 0.43f}, 0.3f);
  const int plaster = add_material(scene, "plaster", {0.55f, 0.37f, 0.28f}, 0.95f);
  const int niche_plaster = add_material(scene, "blue plaster", {0.3f, 0.38f, 0.46f}, 0.9f);
  const int dark = add_material(scene, "dark tile", {0.12f, 0.12f, 0.13f}, 0.2f);
  const int light = add_material(scene, "light tile", {0.62f, 0.6f, 0.56f}, 0.25f);
  const int bronze = add_material(scene, "patinated bronze", {0.24f, 0.34f, 0.28f}, 0.5f, 0.3f);

  add_pedestal(add_mesh(scene, "pedestal", grey), detail);
  add_front(scene, plaster, stone, light, detail);
  add_urn(scene, "left urn", stone, bronze, -2.1f, detail);
  add_urn(scene, "right urn", stone, bronze, 2.1f, detail);
  add_floor(scene, light, dark, detail);
  Mesh& niche_floor = add_mesh(scene, "niche floor", grey);
  add_quad(niche_floor, {-niche_radius, sill, 0.02f}, {niche_radius, sill, 0.02f}, {niche_radius, sill, -niche_radius},
           {-niche_radius, sill, -niche_radius});
  const Mesh figure = figure_with(0.9 * (faces - double(scene.faces())));
  append(add_mesh(scene, "statue", marble), figure, moved({0, sill + 0.7f, 0}));
  add_niche(add_mesh(scene, "niche", niche_plaster), faces - double(scene.faces()));

  scene.cameras = {looking_at("main", {1.3, 1.8, 4.7}, {0.05, 1.7, 0}, 62),
                   looking_at("close", {0.42, 2.62, 1.05}, {0.02, 2.5, 0}, 48),
                   looking_at("drapery", {-0.8, 1.45, 1.3}, {0.02, 1.6, 0}, 60)};
  scene.ao_radius = 0.4;
  scene.light.to_sun = {0.75f, 0.8f, 0.9f};
  return scene;
}

}  // namespace

std::vector<SceneRecipe> statue() {
  return {{.name = "statue",
           .summary = "a draped figure on a pedestal in a niche, at a chosen number of faces",
           .kind = "object",
           .parameters = {int_parameter("faces", 200000, 1000, 5000000, "",
                                        "triangles of the whole scene; met within 2 % from 5000 on, 15 % below")},
           .make = make}};
}

}  // namespace gloam::scenes
