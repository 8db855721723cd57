// The pixels that corner-mask wants, for surfaces with known pixels at which something rises over the tangent plane.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/estimate.h"
#include "support/stress.h"

namespace gloam::test::corner_mask_test {
namespace {

Frame mask_of(const Frame& frame, const Settings& settings = {}) {
  const PlanRequest request{.outputs = {"corner-mask"}, .settings = settings};
  return run(make_plan(request, plane_names(frame), "the frame has not"), frame, device(), {}).frame;
}

double wanted_share(const Frame& mask) {
  double wanted = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) wanted += value_at(mask, "mask", x, y) > 0;
  }
  return wanted / (double(mask.width()) * mask.height());
}

TEST(CornerMask, APlaneCallsForNothing) {
  for (const double tilt : {0.0, 0.5, 1.2}) {
    for (const Shot& shot : {perspective(131, 77), orthographic(131, 77, 4)}) {
      EXPECT_EQ(wanted_share(mask_of(shoot(shot, tilted_plane(3, tilt, 0.7)))), 0) << tilt;
    }
  }
}

TEST(CornerMask, AnEmptyFrameCallsForNothing) {
  EXPECT_EQ(wanted_share(mask_of(shoot(perspective(131, 77), [](const EyeRay&) { return std::nullopt; }))), 0);
}

TEST(CornerMask, ABallCallsForNothingButAtItsRim) {
  // Convex, so open everywhere; background beyond the rim.
  EXPECT_EQ(wanted_share(mask_of(shoot(perspective(131, 77), ball({0, 0, -3}, 0.8)))), 0);
}

TEST(CornerMask, ACornerIsWantedAsFarAsTheRadiusReaches) {
  const Shot shot = perspective(160, 240);
  const Scene scene = corner();
  const Frame frame = shoot(shot, scene);
  const double radius = 0.4;
  for (const int cell : {2, 4, 8}) {
    const Frame mask = mask_of(frame, {{"radius", "0.4"}, {"max_reach", "1"}, {"cell", fmt::format("{}", cell)}});
    int near = 0, far = 0;
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 16; x < shot.width - 16; ++x) {
        const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
        const Surface surface = *scene(ray);
        const glm::dvec3 p = point_at(ray, surface.depth);
        // The walls meet in the line y = 0, z = -4.
        const double distance = std::hypot(p.y, p.z + 4),
                     pixel = surface.depth * 2 * std::tan(std::numbers::pi / 6) / shot.width;
        if (distance < 0.9 * radius) {
          ASSERT_GT(value_at(mask, "mask", x, y), 0) << x << ", " << y << ", cell " << cell;
          ++near;
        } else if (distance > radius + 2 * std::numbers::sqrt2 * (2 * cell + 1) * pixel) {
          ASSERT_EQ(value_at(mask, "mask", x, y), 0) << x << ", " << y << ", cell " << cell;
          ++far;
        }
      }
    }
    EXPECT_GT(near, 1000);
    EXPECT_GT(far, 1000);
  }
}

TEST(CornerMask, AConvexEdgeIsNotWanted) {
  // Seen from the other side of the corner: the walls fall away from the edge.
  const Scene scene = [](const EyeRay& ray) {
    const std::optional<Surface> low = tilted_plane(4, std::numbers::pi / 4, std::numbers::pi / 2)(ray);
    const std::optional<Surface> high = tilted_plane(4, std::numbers::pi / 4, -std::numbers::pi / 2)(ray);
    if (!low || !high) return low ? low : high;
    return low->depth > high->depth ? low : high;
  };
  const Frame mask = mask_of(shoot(perspective(160, 120), scene));
  EXPECT_EQ(wanted_share(mask), 0);
}

TEST(CornerMask, AStepIsWantedBelowAndNotAbove) {
  const Shot shot = orthographic(160, 120, 4);
  const Frame mask = mask_of(shoot(shot, step(0.2)), {{"radius", "0.5"}, {"max_reach", "1"}});
  // 40 pixels per unit; the step is in the middle, and its own cell and the cells around that may be wanted too.
  for (int y = 16; y < 104; ++y) {
    for (int x = 62; x < 80; ++x) ASSERT_GT(value_at(mask, "mask", x, y), 0) << x;
    for (int x = 0; x < 52; ++x) ASSERT_EQ(value_at(mask, "mask", x, y), 0) << x;
    for (int x = 86; x < 160; ++x) ASSERT_EQ(value_at(mask, "mask", x, y), 0) << x;
  }
}

TEST(CornerMask, SsaosOccludersBeyondTheRadiusCountForIt) {
  // A wall 0.8 before the other is out of the radius of 0.5, but within the range that SSAO asks for.
  const Shot shot = orthographic(160, 120, 4);
  const Frame frame = shoot(shot, step(0.8));
  EXPECT_EQ(wanted_share(mask_of(frame, {{"radius", "0.5"}})), 0);
  EXPECT_GT(wanted_share(mask_of(frame, {{"radius", "0.5"}, {"range", "2"}})), 0.05);
}

TEST(CornerMask, LittleIsMissedInARoom) {
  const Frame frame = shoot(perspective(480, 270), room());
  const Frame mask = mask_of(frame);
  for (const char* technique : {"hbao+", "gtao", "alchemy", "hbao"}) {
    const Frame raw = raw_of(technique, frame);
    double missed = 0, needed = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const bool is_occluded = raw_at(raw, x, y) < 254.0f / 255;
        needed += is_occluded;
        missed += is_occluded && value_at(mask, "mask", x, y) == 0;
      }
    }
    const double pixels = double(frame.width()) * frame.height();
    EXPECT_GT(needed / pixels, 0.1) << technique;
    EXPECT_LE(missed / pixels, 0.005) << technique;
  }
}

}  // namespace
}  // namespace gloam::test::corner_mask_test
