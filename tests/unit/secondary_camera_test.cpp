// The second camera: its image holds all that it must, and it turns about its pivot.
#include "gloam/scene/secondary_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "gloam/error.h"
#include "gloam/scene/scene.h"

namespace gloam::secondary_camera_test {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int width = 64, height = 36;

/// The pixel of a world point in an image; none behind the camera.
std::optional<dvec2> projected(const Camera& camera, const dvec3& world) {
  const dvec3 view = camera.pose->world_to_view * (world - camera.pose->position);
  if (!(view.z < 0)) return {};
  const double reach = camera.orthographic ? 1 : -view.z;
  return dvec2(camera.cx + camera.fx * view.x / reach, camera.cy - camera.fy * view.y / reach);
}

/// The world point at a depth under a position in the image.
dvec3 point_at(const Camera& camera, double x, double y, double depth) {
  const double reach = camera.orthographic ? 1 : depth;
  const dvec3 view(reach * (x - camera.cx) / camera.fx, reach * (camera.cy - y) / camera.fy, -depth);
  return camera.pose->position + glm::transpose(camera.pose->world_to_view) * view;
}

dvec3 axis_of(const Camera& camera) { return glm::transpose(camera.pose->world_to_view) * dvec3(0, 0, -1); }

std::vector<dvec3> corners_of(const Camera& camera, const VisibleDepths& depths) {
  std::vector<dvec3> corners;
  for (const double depth : {depths.nearest, depths.farthest}) {
    for (const double x : {0, width}) {
      for (const double y : {0, height}) corners.push_back(point_at(camera, x, y, depth));
    }
  }
  return corners;
}

struct Case {
  std::string name;
  Camera first;
};

std::vector<Case> cases() {
  SceneCamera level = looking_at("level", {3, 2, 6}, {3, 2, 0}, 60);
  SceneCamera down = looking_at("down", {1e7, 2e6, -3e7}, {1e7 + 1, 2e6 - 2, -3e7 - 1}, 90);
  SceneCamera narrow = looking_at("narrow", {0, 1, 0}, {1, 1.2, 1}, 8);
  std::vector<Case> cases;
  for (const SceneCamera& camera : {level, down, narrow}) {
    cases.push_back({camera.name, camera_for(camera, width, height)});
    Case off_axis{camera.name + ", off-axis, pixels not square", cases.back().first};
    off_axis.first.cx += 21.5, off_axis.first.cy -= 9.25, off_axis.first.fy *= 1.4;
    cases.push_back(off_axis);
    SceneCamera flat = camera;
    flat.orthographic = true, flat.width = 5;
    cases.push_back({camera.name + ", orthographic", camera_for(flat, width, height)});
  }
  return cases;
}

const std::vector<VisibleDepths> depth_ranges = {{2, 4, 9},    {3.9, 4, 4.1}, {4, 4, 4},
                                                 {0.01, 4, 5}, {3, 4, 5000},  {4e-9, 5e-9, 7e-9}};
const double angles[] = {-90, -60, -5, 0.5, 15, 30, 45, 75, 90};

/// Every case, every range of depths, every angle.
template <typename Check>
void for_all(Check check) {
  for (const Case& test : cases()) {
    for (const VisibleDepths& depths : depth_ranges) {
      for (const double degrees : angles) {
        SCOPED_TRACE(fmt::format("{}, depths {} {} {}, {} degrees", test.name, depths.nearest, depths.median,
                                 depths.farthest, degrees));
        check(test.first, depths, degrees, secondary_camera(test.first, width, height, depths, degrees));
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

/// Rounding of positions in double, this far from the origin.
double rounding_of(const Camera& camera, const VisibleDepths& depths) {
  return 1e-15 * glm::length(camera.pose->position) / depths.nearest;
}

TEST(SecondaryCamera, AllThatIsVisibleLiesInTheImage) {
  for_all([](const Camera& first, const VisibleDepths& depths, double, const Camera& second) {
    if (rounding_of(first, depths) > 1e-3) return;  // nothing of that size can be resolved at that position
    for (const dvec3& corner : corners_of(first, depths)) {
      const auto pixel = projected(second, corner);
      ASSERT_TRUE(pixel) << "behind the camera";
      EXPECT_GT(pixel->x, 0);
      EXPECT_LT(pixel->x, width);
      EXPECT_GT(pixel->y, 0);
      EXPECT_LT(pixel->y, height);
    }
  });
}

TEST(SecondaryCamera, TheImageIsNoLargerThanItMustBe) {
  for_all([](const Camera& first, const VisibleDepths& depths, double, const Camera& second) {
    if (rounding_of(first, depths) > 1e-3) return;
    dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const dvec3& corner : corners_of(first, depths)) {
      const auto pixel = projected(second, corner);
      ASSERT_TRUE(pixel);
      low = glm::min(low, *pixel), high = glm::max(high, *pixel);
    }
    const dvec2 filled = (high - low) / dvec2(width, height);
    EXPECT_NEAR(std::max(filled.x, filled.y), 1 / 1.01, 1e-3) << "one of both directions is filled";
  });
}

TEST(SecondaryCamera, BordersAreAtMost60DegreesOffTheAxis) {
  const double most = std::tan(glm::radians(60.0)) * (1 + 1e-9);
  int moved_back = 0;
  for_all([&](const Camera& first, const VisibleDepths& depths, double, const Camera& second) {
    if (first.orthographic) return;
    EXPECT_LE(second.cx / second.fx, most);
    EXPECT_LE((width - second.cx) / second.fx, most);
    EXPECT_LE(second.cy / second.fy, most);
    EXPECT_LE((height - second.cy) / second.fy, most);
    if (rounding_of(first, depths) > 1e-3) return;
    const dvec3 pivot = first.pose->position + depths.median * axis_of(first);
    const double distance = glm::length(second.pose->position - pivot) / depths.median;
    EXPECT_GT(distance, 1 - 1e-6) << "never nearer";
    if (distance < 1 + 1e-6) return;
    ++moved_back;
    const double widest = std::max({second.cx / second.fx, (width - second.cx) / second.fx, second.cy / second.fy,
                                    (height - second.cy) / second.fy});
    EXPECT_NEAR(widest, std::tan(glm::radians(60.0)), 1e-6) << "and not farther than it must be";
  });
  EXPECT_GT(moved_back, 20);
}

TEST(SecondaryCamera, ThePivotStaysInPlace) {
  for_all([](const Camera& first, const VisibleDepths& depths, double degrees, const Camera& second) {
    EXPECT_NEAR(glm::degrees(std::acos(glm::dot(axis_of(first), axis_of(second)))), std::abs(degrees), 1e-6);
    if (rounding_of(first, depths) > 1e-9) return;
    const dvec3 pivot = first.pose->position + depths.median * axis_of(first);
    const auto pixel = projected(second, pivot);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, second.cx, 1e-6 * second.fx);
    EXPECT_NEAR(pixel->y, second.cy, 1e-6 * second.fy);
    const double aside = (first.pose->world_to_view * (second.pose->position - first.pose->position)).x;
    EXPECT_GT(aside * degrees, 0) << "positive: to the right";
    const double upwards = (first.pose->world_to_view * (second.pose->position - first.pose->position)).y;
    EXPECT_NEAR(upwards, 0, 1e-6 * depths.median);
  });
}

TEST(SecondaryCamera, ACameraAsItShouldBe) {
  Camera first = camera_for(looking_at("main", {0, 0, 4}, {0, 0, 0}, 40), width, height);
  first.near = 2, first.far = 9, first.fy *= 1.25;
  const Camera second = secondary_camera(first, width, height, {3.5, 4, 4.5}, 90);
  EXPECT_NEAR(second.pose->position.x, 4, 1e-12);
  EXPECT_NEAR(second.pose->position.z, 0, 1e-12);
  EXPECT_NEAR(axis_of(second).x, -1, 1e-12);
  EXPECT_NEAR(second.fy / second.fx, 1.25, 1e-12) << "pixels keep their shape";
  EXPECT_FALSE(second.near || second.far) << "nothing clips";
  EXPECT_FALSE(second.orthographic);
  EXPECT_NE(second.source.find("turned 90 degrees"), std::string::npos) << second.source;
  const double determinant = glm::determinant(second.pose->world_to_view);
  EXPECT_NEAR(determinant, 1, 1e-12) << "a rotation";
}

// One plane in both views: the point of a pixel in one view has the same position in the other.
TEST(SecondaryCamera, BothSeeAPlaneAtTheSamePlace) {
  const dvec3 normal = glm::normalize(dvec3(0.2, 1, 0.3));
  const double offset = -0.7;
  for (const bool orthographic : {false, true}) {
    SceneCamera seen = looking_at("main", {0.5, 2, 5}, {0, -0.5, 0}, 50);
    seen.orthographic = orthographic, seen.width = 4;
    const Camera first = camera_for(seen, width, height);
    const auto depth_under = [&](const Camera& camera, double x, double y) {
      const dvec3 from = point_at(camera, x, y, 0), along = point_at(camera, x, y, 1) - from;
      return (offset - glm::dot(normal, from)) / glm::dot(normal, along);
    };
    Channel depth(Layout(width, height));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) depth.at(x, y) = float(depth_under(first, x + 0.5, y + 0.5));
    }
    const auto depths = visible_depths(depth);
    ASSERT_TRUE(depths);
    const Camera second = secondary_camera(first, width, height, *depths, 30);
    int inside = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const dvec3 world = point_at(first, x + 0.5, y + 0.5, depth.at(x, y));
        const auto pixel = projected(second, world);
        ASSERT_TRUE(pixel);
        EXPECT_LT(glm::length(point_at(second, pixel->x, pixel->y, depth_under(second, pixel->x, pixel->y)) - world),
                  1e-5);
        inside += pixel->x > 0 && pixel->x < width && pixel->y > 0 && pixel->y < height;
      }
    }
    EXPECT_GE(inside, width * height * 96 / 100) << "all between the 2nd and the 98th percentile";
  }
}

TEST(VisibleDepths, ArePercentilesOfWhatIsThere) {
  const float background = std::numeric_limits<float>::infinity();
  Channel depth(Layout(50, 21), background);
  EXPECT_FALSE(visible_depths(depth));
  int number = 0;
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 50; ++x) {
      if ((x + y) % 2 == 0 && number <= 500) depth.at(x, y) = float((number++ * 377) % 501);  // 0 to 500, each once
    }
  }
  ASSERT_EQ(number, 501);
  const auto depths = visible_depths(depth);
  ASSERT_TRUE(depths);
  EXPECT_EQ(depths->nearest, 10);
  EXPECT_EQ(depths->median, 250);
  EXPECT_EQ(depths->farthest, 490);
}

}  // namespace
}  // namespace gloam::secondary_camera_test
