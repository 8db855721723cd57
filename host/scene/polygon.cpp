#include "scene/polygon.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

namespace gloam {

using glm::vec2;

namespace {

float twice_area(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Whether `p` lies between a and b, ends excluded.
bool lies_between(vec2 p, vec2 a, vec2 b) {
  return twice_area(a, b, p) == 0 && glm::dot(p - a, b - a) > 0 && glm::dot(p - b, a - b) > 0;
}

/// Whether the segment from a to b crosses the side from c to d, or passes through one of its ends.
bool cross(vec2 a, vec2 b, vec2 c, vec2 d) {
  if (lies_between(c, a, b) || lies_between(d, a, b)) return true;
  if (a == c || a == d || b == c || b == d) return false;
  const float ac = twice_area(c, d, a), bc = twice_area(c, d, b), ca = twice_area(a, b, c), da = twice_area(a, b, d);
  return ((ac >= 0) != (bc >= 0)) && ((ca >= 0) != (da >= 0));
}

/// Whether the segment from a corner of a counter-clockwise loop to `point` starts inside the loop, or along its sides.
bool starts_inside(vec2 before, vec2 at, vec2 after, vec2 point) {
  if (point == before || point == after) return true;
  const bool left_of_after = twice_area(at, after, point) > 0, right_of_before = twice_area(at, before, point) < 0;
  return twice_area(before, at, after) >= 0 ? left_of_after && right_of_before : left_of_after || right_of_before;
}

/// The corner of `loop` nearest to corner `start` of `hole` that can be joined to it without crossing the loop or a hole.
size_t joining_corner(const std::vector<vec2>& loop, const std::vector<std::vector<vec2>>& holes,
                      const std::vector<vec2>& hole, size_t start) {
  const vec2 point = hole[start];
  const vec2 hole_before = hole[(start + 1) % hole.size()], hole_after = hole[(start + hole.size() - 1) % hole.size()];
  size_t best = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < loop.size(); ++i) {
    const float distance = glm::length(loop[i] - point);
    const vec2 before = loop[(i + loop.size() - 1) % loop.size()], after = loop[(i + 1) % loop.size()];
    if (distance >= nearest || !starts_inside(before, loop[i], after, point)) continue;
    if (!starts_inside(hole_before, point, hole_after, loop[i])) continue;
    const auto crossed = [&](const std::vector<vec2>& other) {
      for (size_t k = 0; k < other.size(); ++k) {
        if (cross(point, loop[i], other[k], other[(k + 1) % other.size()])) return true;
      }
      return false;
    };
    if (crossed(loop) || std::any_of(holes.begin(), holes.end(), crossed)) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

bool is_ear(const std::vector<vec2>& left, size_t i) {
  const size_t n = left.size();
  const vec2 a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
  if (twice_area(a, b, c) <= 0) return false;
  // Corners of a seam occur twice: the cut must run on this side of it.
  if (!starts_inside(left[(i + n - 2) % n], a, b, c) || !starts_inside(b, c, left[(i + 2) % n], a)) return false;
  for (const vec2 p : left) {
    if (p == a || p == b || p == c) continue;
    if (twice_area(a, b, p) >= 0 && twice_area(b, c, p) >= 0 && twice_area(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<vec2> joined(std::vector<vec2> loop, std::vector<std::vector<vec2>> holes) {
  const auto is_left = [](vec2 a, vec2 b) { return a.x < b.x; };
  const auto rightmost = [&](const std::vector<vec2>& hole) {
    return std::max_element(hole.begin(), hole.end(), is_left);
  };
  std::sort(holes.begin(), holes.end(),
            [&](const auto& a, const auto& b) { return rightmost(a)->x > rightmost(b)->x; });
  for (const std::vector<vec2>& hole : holes) {
    const size_t start = size_t(rightmost(hole) - hole.begin());
    const size_t corner = joining_corner(loop, holes, hole, start);
    std::vector<vec2> detour;
    for (size_t k = 0; k <= hole.size(); ++k) detour.push_back(hole[(start + hole.size() - k) % hole.size()]);
    detour.push_back(loop[corner]);
    loop.insert(loop.begin() + long(corner) + 1, detour.begin(), detour.end());
  }
  return loop;
}

std::vector<glm::uvec3> triangulated(const std::vector<vec2>& outline) {
  std::vector<unsigned> names(outline.size());
  for (size_t i = 0; i < names.size(); ++i) names[i] = unsigned(i);
  std::vector<vec2> left = outline;
  const auto remove = [&](size_t i) {
    names.erase(names.begin() + long(i));
    left.erase(left.begin() + long(i));
  };
  const auto is_spike = [&](size_t i) {
    return left[(i + left.size() - 1) % left.size()] == left[(i + 1) % left.size()];
  };
  std::vector<glm::uvec3> triangles;
  while (left.size() > 2) {
    const size_t n = left.size();
    size_t i = 0;
    while (i < n && !is_spike(i)) ++i;
    if (i < n) {  // both sides of a seam are done
      remove(i);
      remove(i % left.size());
      continue;
    }
    while (i > 0 && !is_ear(left, n - i)) --i;
    const size_t ear = i > 0 ? n - i : 0;
    if (i > 0) triangles.push_back({names[(ear + n - 1) % n], names[ear], names[(ear + 1) % n]});
    remove(ear);  // without an ear, the rest is a line: no area to fill
  }
  return triangles;
}

}  // namespace gloam
