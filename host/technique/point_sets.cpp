#include "technique/point_sets.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numeric>
#include <optional>

#include "gloam/error.h"
#include "shared/both/hash.h"

namespace gloam {
namespace {

/// A stream of random numbers. All decisions are made on integers, and the results are exact in double: the same bits with and
/// without fused multiply-adds.
class RandomStream {
 public:
  explicit RandomStream(uint32_t seed) : start_(hash_of(seed)), mask_(hash_of(seed ^ 0x9e3779b9u)) {}

  uint32_t bits() { return hash_of(hash_of(start_ + count_++) ^ mask_); }
  /// In [0,1), a multiple of 2^-32.
  double unit() { return bits() * 0x1p-32; }
  /// In [0,1), a multiple of 2^-26: the sum of two squares of such numbers is exact.
  double coarse_unit() { return (bits() >> 6) * 0x1p-26; }
  /// In 0..bound - 1.
  size_t below(size_t bound) { return size_t(uint64_t(bits()) * bound >> 32); }

 private:
  uint32_t start_, mask_, count_ = 0;
};

/// One number in each of `count` equal intervals of [0,1), shuffled.
std::vector<double> shuffled_strata(int count, RandomStream& random) {
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  std::vector<double> strata;
  for (const int stratum : order) strata.push_back((stratum + random.unit()) / count);
  return strata;
}

std::vector<glm::dvec2> random_points(int count, RandomStream& random) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < count; ++i) {
    const double u = random.unit();
    points.push_back({u, random.unit()});
  }
  return points;
}

/// Rows differ by at most one cell, and a row's height is its share of the cells, so that all cells have the same area.
std::vector<glm::dvec2> jittered_points(int count, RandomStream& random) {
  const int rows = int(std::lround(std::sqrt(count)));
  std::vector<glm::dvec2> points;
  for (int row = 0; row < rows; ++row) {
    const int begin = row * count / rows, cells = (row + 1) * count / rows - begin;
    for (int cell = 0; cell < cells; ++cell) {
      const double u = (begin + cells * random.unit()) / count;
      points.push_back({u, (cell + random.unit()) / cells});
    }
  }
  return points;
}

std::vector<glm::dvec2> latin_points(int count, RandomStream& random) {
  std::vector<glm::dvec2> points;
  for (const double u : shuffled_strata(count, random))
    points.push_back({u, (int(points.size()) + random.unit()) / count});
  return points;
}

/// Points on the unit square with v periodic, in cells no smaller than `distance`: the neighbours of a point are in its cell and
/// those around it.
class Disks {
 public:
  explicit Disks(double distance)
      : squared_distance_(distance * distance), side_(std::max(1, int(1 / distance))), cells_(size_t(side_ * side_)) {}

  bool has_room_for(const glm::dvec2& point) const {
    const int row = place(point.x), column = place(point.y);
    for (int near_row = std::max(row - 1, 0); near_row <= std::min(row + 1, side_ - 1); ++near_row)
      for (int step = -1; step <= 1; ++step)
        if (touches(cell(near_row, (column + step + side_) % side_), point)) return false;
    return true;
  }

  void add(const glm::dvec2& point) {
    cells_[size_t(place(point.x) * side_ + place(point.y))].push_back(point);
    points_.push_back(point);
  }

  const std::vector<glm::dvec2>& points() const { return points_; }

 private:
  using Points = std::vector<glm::dvec2>;

  int place(double coordinate) const { return int(coordinate * side_); }
  const Points& cell(int row, int column) const { return cells_[size_t(row * side_ + column)]; }

  bool touches(const Points& others, const glm::dvec2& point) const {
    return std::any_of(others.begin(), others.end(), [&](const glm::dvec2& other) {
      const double du = point.x - other.x, straight = std::abs(point.y - other.y),
                   dv = std::min(straight, 1 - straight);
      return du * du + dv * dv < squared_distance_;
    });
  }

  double squared_distance_;
  int side_;
  std::vector<Points> cells_;
  Points points_;
};

/// Largest distance that `count` points can keep on a strip that is 1 wide and periodic in v: the densest packing of disks over
/// the strip and a margin of half a disk (Groemer 1960), 2 / (sqrt(3) d^2) + 1 / d = count.
double largest_distance(int count) { return (1 + std::sqrt(1 + 8 / std::sqrt(3.0) * count)) / (2 * count); }

/// Points that keep `distance`; none if the darts leave no room before there are `count`.
std::optional<std::vector<glm::dvec2>> throw_darts(int count, double distance, RandomStream& random) {
  Disks disks(distance);
  for (int tries = 500 * count; tries > 0; --tries) {
    const double u = random.coarse_unit();
    const glm::dvec2 dart(u, random.coarse_unit());
    if (!disks.has_room_for(dart)) continue;
    disks.add(dart);
    if (int(disks.points().size()) == count) return disks.points();
  }
  return std::nullopt;
}

/// Darts fill a plane at 0.777 of the largest distance (Feder 1980), but take for ever; a little below, they do not.
std::vector<glm::dvec2> poisson_points(int count, RandomStream& random) {
  double distance = 0.74 * largest_distance(count);
  while (true) {
    if (const auto points = throw_darts(count, distance, random)) return *points;
    distance *= 0.99;
  }
}

std::vector<glm::dvec2> plane_points(PointSet set, int count, RandomStream& random) {
  switch (set) {
    case PointSet::random:
      return random_points(count, random);
    case PointSet::jittered:
      return jittered_points(count, random);
    case PointSet::latin_square:
      return latin_points(count, random);
    case PointSet::poisson_disk:
      return poisson_points(count, random);
  }
  throw Error("there is no point set {}", int(set));
}

}  // namespace

std::vector<glm::dvec3> point_set(PointSet set, int count, uint32_t seed) {
  if (count < 1 || count > max_point_set_count)
    throw UsageError("a set of {} points: a point set has 1 to {} points", count, max_point_set_count);
  RandomStream random(seed);
  std::vector<double> w = shuffled_strata(count, random);
  if (set == PointSet::random) std::generate(w.begin(), w.end(), [&] { return random.unit(); });
  std::vector<glm::dvec3> points;
  for (const glm::dvec2& point : plane_points(set, count, random)) points.emplace_back(point, w[points.size()]);
  return points;
}

}  // namespace gloam
