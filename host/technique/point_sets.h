// Small sets of sample points: random ones, and three more evenly spread kinds.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gloam {

/// How the points of a set are spread over (u, v), after Doronin, Kara, Barsi and Martini 2017, section 6. There they are points
/// about a sphere by its cylindrical parametrisation: u is the height, v the angle in turns (0 and 1 are the same v), and w the
/// distance from the centre. Equal areas of (u, v) are equal areas of the sphere.
enum class PointSet {
  /// Independent and uniform, also w.
  random,
  /// One in each of `count` cells of equal area. The cells lie in rows along v, as near to squares as the count allows.
  jittered,
  /// One in each of `count` equal intervals of u, and one in each of `count` equal intervals of v.
  latin_square,
  /// No two points are nearer to each other than a distance, with v periodic: about 0.74 of the largest distance that `count`
  /// points can keep (at least 0.7 for 16 points and more). By throwing darts.
  poisson_disk,
};

constexpr int max_point_set_count = 2048;

/// `count` points (u, v, w), each coordinate in [0,1), in arbitrary order. All sets but `random` have one w in each of `count`
/// equal intervals, independent of (u, v). The same bits on every machine; each `seed` gives another set of its kind. Throws
/// UsageError for a `count` outside 1..max_point_set_count.
std::vector<glm::dvec3> point_set(PointSet set, int count, uint32_t seed);

}  // namespace gloam
