// The promises of each kind of point set, for counts that are squares, primes and neither, and the benefit of even sets.
#include "technique/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <map>
#include <random>

#include "unit/message_of.h"

namespace gloam::test::point_sets_test {
namespace {

using Points = std::vector<glm::dvec3>;

const std::vector<PointSet> all_sets{PointSet::random, PointSet::jittered, PointSet::latin_square,
                                     PointSet::poisson_disk};
const std::vector<int> counts{1, 2, 3, 4, 7, 12, 16, 31, 64, 100, 200, 499, 1024, 2048};

/// Number of values in each of `count` equal intervals of [0,1). Coordinates in the last or first 2^-32 of an interval must stay
/// in it: 1e-11 is far below that, and far above the rounding.
std::vector<int> occupancy(const std::vector<double>& values) {
  std::vector<int> found(values.size());
  for (const double value : values) ++found.at(size_t(value * double(values.size()) + 1e-11));
  return found;
}

std::vector<double> coordinate(const Points& points, int axis) {
  std::vector<double> values;
  for (const glm::dvec3& point : points) values.push_back(point[axis]);
  return values;
}

bool one_in_each(const std::vector<double>& values) { return occupancy(values) == std::vector<int>(values.size(), 1); }

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  const double straight = std::abs(a.y - b.y);
  return std::hypot(a.x - b.x, std::min(straight, 1 - straight));
}

double smallest_distance(const Points& points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t k = 0; k < i; ++k) smallest = std::min(smallest, distance(points[i], points[k]));
  return smallest;
}

/// An upper bound: `count` disks of this diameter, packed as densely as possible, fill the unit square and half a disk more at
/// its two open edges.
double largest_distance(int count) { return (1 + std::sqrt(1 + 8 / std::sqrt(3.0) * count)) / (2 * count); }

/// Root of the mean squared error of the area below a line across the unit square, v < height + slope u, as the share of
/// points below it. The lines stay between v = 0 and v = 1, so that their area is exact: height + slope / 2.
double area_error(PointSet set, int count) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> end(0, 1);
  double sum = 0;
  const int tries = 400;
  for (int i = 0; i < tries; ++i) {
    const double left = end(engine), right = end(engine);
    const Points points = point_set(set, count, uint32_t(i));
    const auto below = std::count_if(points.begin(), points.end(), [&](const glm::dvec3& point) {
      return point.y < left + (right - left) * point.x;
    });
    sum += std::pow(double(below) / count - (left + right) / 2, 2);
  }
  return std::sqrt(sum / tries);
}

TEST(PointSets, HaveTheirCountWithinTheUnitCube) {
  for (const PointSet set : all_sets)
    for (const int count : counts) {
      const Points points = point_set(set, count, 3);
      ASSERT_EQ(points.size(), size_t(count));
      for (const glm::dvec3& point : points)
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(point[axis], 0);
          EXPECT_LT(point[axis], 1);
        }
    }
}

TEST(PointSets, RepeatAndDifferBySeedAndByKind) {
  for (const PointSet set : all_sets) {
    EXPECT_EQ(point_set(set, 64, 8), point_set(set, 64, 8));
    EXPECT_NE(point_set(set, 64, 8), point_set(set, 64, 9));
    EXPECT_NE(point_set(set, 64, 0), point_set(set, 64, 1));
    for (const PointSet other : all_sets) EXPECT_EQ(point_set(set, 64, 8) == point_set(other, 64, 8), set == other);
  }
}

/// Bits, so that a change of the generator, or a machine that rounds differently, is noticed.
TEST(PointSets, AreTheSameOnEveryMachine) {
  const auto last = [](PointSet set) { return point_set(set, 100, 1).back(); };
  EXPECT_EQ(last(PointSet::random), glm::dvec3(0x1.85c1e52p-1, 0x1.92081288p-3, 0x1.880387ap-2));
  EXPECT_EQ(last(PointSet::jittered), glm::dvec3(0x1.ec0dbb25ccccdp-1, 0x1.e959daa166666p-1, 0x1.587c9040f5c29p-5));
  EXPECT_EQ(last(PointSet::latin_square), glm::dvec3(0x1.9cb9b16f4cccdp-1, 0x1.fec70f175c28fp-1, 0x1.587c9040f5c29p-5));
  EXPECT_EQ(last(PointSet::poisson_disk), glm::dvec3(0x1.86ff8p-4, 0x1.cd9ac4p-4, 0x1.587c9040f5c29p-5));
}

TEST(PointSets, JitteredHasOnePointInEachCellOfEqualArea) {
  for (const int side : {2, 5, 10, 32}) {
    const Points points = point_set(PointSet::jittered, side * side, 4);
    std::map<std::pair<int, int>, int> cells;
    for (const glm::dvec3& point : points) ++cells[{int(point.x * side + 1e-11), int(point.y * side + 1e-11)}];
    EXPECT_EQ(cells.size(), points.size()) << side;
  }
}

/// 12 = 4 + 4 + 4 makes rows of equal cells; 7 = 2 + 2 + 3 and 23 = 4 + 5 + 4 + 5 + 5 do not: the cells of a row of three are
/// narrower, and the row is higher.
TEST(PointSets, JitteredHasEqualAreasForEveryCount) {
  const std::map<int, std::vector<int>> rows_of{{1, {1}},       {2, {2}},        {3, {1, 2}},
                                                {7, {2, 2, 3}}, {12, {4, 4, 4}}, {23, {4, 5, 4, 5, 5}}};
  for (const auto& [count, rows] : rows_of)
    for (uint32_t seed = 0; seed < 20; ++seed) {
      const Points points = point_set(PointSet::jittered, count, seed);
      int begin = 0;
      for (const int cells : rows) {
        std::vector<double> along;
        for (const glm::dvec3& point : points) {
          const double place = point.x * count + 1e-11;
          if (place >= begin && place < begin + cells) along.push_back(point.y);
        }
        EXPECT_EQ(along.size(), size_t(cells)) << count;
        EXPECT_TRUE(one_in_each(along)) << count;
        begin += cells;
      }
      EXPECT_EQ(begin, count);
    }
}

/// Jitter fills its cells: over many seeds the position in a cell is uniform. For 400 values, the mean is within 4 standard
/// deviations of 1/2, 0.289 / sqrt(400) each.
TEST(PointSets, JitterFillsTheCell) {
  double sum = 0, smallest = 1, largest = 0;
  for (uint32_t seed = 0; seed < 100; ++seed)
    for (const glm::dvec3& point : point_set(PointSet::jittered, 4, seed)) {
      const double place = point.x * 2 - std::floor(point.x * 2);
      sum += place;
      smallest = std::min(smallest, place);
      largest = std::max(largest, place);
    }
  EXPECT_NEAR(sum / 400, 0.5, 4 * 0.289 / 20);
  EXPECT_LT(smallest, 0.02);
  EXPECT_GT(largest, 0.98);
}

TEST(PointSets, LatinSquareHasOnePointInEachRowAndColumn) {
  for (const int count : counts) {
    const Points points = point_set(PointSet::latin_square, count, 6);
    EXPECT_TRUE(one_in_each(coordinate(points, 0))) << count;
    EXPECT_TRUE(one_in_each(coordinate(points, 1))) << count;
  }
  EXPECT_FALSE(one_in_each(coordinate(point_set(PointSet::random, 64, 6), 0)));
  EXPECT_FALSE(one_in_each(coordinate(point_set(PointSet::jittered, 64, 6), 1)));
}

/// Every permutation occurs: 3 points have 6, each with a sixth of 600 seeds (standard deviation 9.1).
TEST(PointSets, LatinSquareIsAnyPermutation) {
  std::map<std::vector<int>, int> found;
  for (uint32_t seed = 0; seed < 600; ++seed) {
    Points points = point_set(PointSet::latin_square, 3, seed);
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    std::vector<int> rows;
    for (const glm::dvec3& point : points) rows.push_back(int(point.x * 3 + 1e-11));
    ++found[rows];
  }
  EXPECT_EQ(found.size(), 6u);
  for (const auto& [rows, times] : found) EXPECT_NEAR(times, 100, 4 * 9.1);
}

TEST(PointSets, PoissonDiskKeepsItsDistance) {
  for (const int count : {16, 31, 64, 100, 200, 499, 1024, 2048})
    for (uint32_t seed = 0; seed < 5; ++seed) {
      const double most = largest_distance(count);
      EXPECT_GT(smallest_distance(point_set(PointSet::poisson_disk, count, seed)), 0.7 * most) << count << " " << seed;
      // Checks that the bound holds.
      EXPECT_LT(smallest_distance(point_set(PointSet::poisson_disk, count, seed)), most);
      EXPECT_LT(smallest_distance(point_set(PointSet::random, count, seed)), 0.5 * most);
    }
}

/// v is periodic, u is not: points within the distance across v = 0 do not occur, across u = 0 they do.
TEST(PointSets, PoissonDiskIsPeriodicInTheAngleOnly) {
  bool across_u = false;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const Points points = point_set(PointSet::poisson_disk, 200, seed);
    const double kept = smallest_distance(points);
    for (const glm::dvec3& a : points)
      for (const glm::dvec3& b : points) across_u |= std::hypot(a.x + 1 - b.x, a.y - b.y) < 0.9 * kept;
  }
  EXPECT_TRUE(across_u);
}

TEST(PointSets, WIsStratifiedApartFromTheRest) {
  for (const PointSet set : all_sets) {
    const Points points = point_set(set, 200, 2);
    EXPECT_EQ(one_in_each(coordinate(points, 2)), set != PointSet::random);
    // Uncorrelated with the order of u and of v: correlations of 200 pairs have a standard deviation of 1/sqrt(200).
    for (const int axis : {0, 1}) {
      double sum = 0;
      for (const glm::dvec3& point : points) sum += (point[axis] - 0.5) * (point.z - 0.5) * 12;
      EXPECT_NEAR(sum / 200, 0, 4 / std::sqrt(200)) << int(set) << " " << axis;
    }
  }
}

/// The error of independent points is known: the variance of one is the mean of p (1 - p), for p the mean of two uniform numbers:
/// 1/2 - (1/4 + 1/24) = 5/24.
TEST(PointSets, SpreadPointsMeasureAreasBetter) {
  const double random = area_error(PointSet::random, 64);
  EXPECT_NEAR(random, std::sqrt(5.0 / 24 / 64), 0.1 * std::sqrt(5.0 / 24 / 64));
  EXPECT_LT(area_error(PointSet::latin_square, 64), 0.8 * random);
  EXPECT_LT(area_error(PointSet::jittered, 64), 0.5 * random);
  EXPECT_LT(area_error(PointSet::poisson_disk, 64), 0.6 * random);
}

TEST(PointSets, RefuseACountOutsideTheirRange) {
  for (const PointSet set : all_sets)
    for (const int count : {-1, 0, 2049}) {
      EXPECT_THROW(point_set(set, count, 0), UsageError);
      const std::string message = message_of([&] { point_set(set, count, 0); });
      EXPECT_NE(message.find(std::to_string(count)), std::string::npos) << message;
      EXPECT_NE(message.find("1 to 2048"), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace gloam::test::point_sets_test
