// A thin strip before a wall: points beside it see past it, and must not be shaded as if the strip were a block down to the wall.
// The truth is the share of the cosine-weighted hemisphere that the strip covers within the radius, in double.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::thin_occluder_test {
namespace {

constexpr double radius = 0.8, wall = 4, height = 0.55, half_width = 0.03, half_length = 2;

Scene strip_before_wall() {
  return nearest_of({within(tilted_plane(wall - height, 0, 0), half_width, half_length), tilted_plane(wall, 0, 0)});
}

/// AO of the wall at distance `x` from the strip's middle.
double open_beside(double x) {
  constexpr int n = 800;
  double covered = 0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      // Evenly over the disk under the hemisphere: cosine-weighted.
      const double r = std::sqrt((i + 0.5) / n), turn = 2 * std::numbers::pi * (k + 0.5) / n;
      const double up = std::sqrt(1 - r * r), distance = height / up;
      const double hit_x = x + r * std::cos(turn) * distance, hit_y = r * std::sin(turn) * distance;
      if (distance < radius && std::abs(hit_x) <= half_width && std::abs(hit_y) <= half_length) covered += 1;
    }
  }
  return 1 - covered / (double(n) * n);
}

/// Mean error of a technique on the wall from 0.1 to 0.5 beside the strip.
double mean_error(const std::string& technique, const Settings& settings) {
  const Shot shot = perspective(440, 360);
  const Frame frame = shoot(shot, strip_before_wall());
  const Plan plan =
      make_plan({.outputs = {technique}, .only_outputs = {"ao_raw"}, .filter = "none", .settings = settings},
                {"depth", "normal"}, "");
  const Frame out = run(plan, frame, device(), {.math = Math::precise}).frame;
  double sum = 0;
  int count = 0;
  const int y = 180;
  for (int x = 0; x < shot.width; ++x) {
    const double beside = wall * ray_through(shot, x + 0.5, y + 0.5).direction.x;
    if (std::abs(beside) < 0.1 || std::abs(beside) > 0.5) continue;
    sum += out.views[0].find("ao_raw")->channels[0].at(x, y) - open_beside(beside);
    ++count;
  }
  return sum / count;
}

TEST(ThinOccluder, DoesNotShadeLikeAWall) {
  ONLY_IN_LONG_RUN();
  const Settings converged = {{"radius", "0.8"}, {"directions", "16"}, {"steps", "64"}, {"jitter", "off"}};
  Settings thinner = converged;
  thinner.push_back({"thickness", "0.05"});
  const double horizon = mean_error("gtao", converged), sectors = mean_error("bitmask", converged),
               thin = mean_error("bitmask", thinner);
  std::printf(
      "beside a strip %.2f wide and %.2f before a wall: gtao %.4f off, bitmask %.4f, with a thickness of 0.05 %.4f\n",
      2 * half_width, height, horizon, sectors, thin);
  // Everything below the horizon counts as closed: the error that the thickness corrects.
  EXPECT_LT(horizon, -0.1);
  EXPECT_LT(std::abs(sectors), 0.6 * std::abs(horizon));
  EXPECT_LT(std::abs(thin), 0.2 * std::abs(horizon));
}

}  // namespace
}  // namespace gloam::test::thin_occluder_test
