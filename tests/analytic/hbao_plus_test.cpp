// HBAO+ against the integral that its samples estimate, over surfaces known in closed form.
//
// With ever more directions and steps the estimate tends to
//   AO = 1 - 2 * mean over screen directions and over distances t (pixels, uniform from 1 to the projected radius P) of
//        W(|v|) max(0, n.v/|v| - bias),   W = max(0, 1 - v^2 / R^2),
// v: from the point to the surface seen at distance t. The kernel differs from that by noise, which is measured, by float, and
// because it reads pixel centres: an error of second order in 1/P on smooth surfaces, of first order around outlines.
#include <gtest/gtest.h>

#include "support/integral.h"

namespace gloam::test::hbao_plus_test {
namespace {

constexpr double radius = 0.8, bias = 0.1;

/// By the midpoint rule.
double integral(const IntegralCase& test, glm::ivec2 pixel) {
  const double reach = pixels_across(test.shot, radius, receiver_at(test, pixel).surface.depth);
  return 1 - 2 * mean_on_screen(test, pixel, 1, reach, 360, 600, obscurance(radius, bias));
}

TEST(HbaoPlusIntegral, CornerAndBall) {
  const Settings settings = joined({{"radius", fmt::format("{}", radius)}, {"bias", fmt::format("{}", bias)}},
                                   find_technique("hbao+").converged);
  for (const IntegralCase& test : integral_cases()) expect_integral(test, "hbao+", settings, integral);
}

TEST(HbaoPlusIntegral, Plane) {
  for (const double tilt : {0.0, 0.7, 1.3, 1.5}) {
    const Frame frame = shoot(perspective(160, 120), tilted_plane(3, tilt, 0.4));
    for (const char* bias : {"0.1", "0"}) {
      const Settings settings = joined({{"bias", bias}}, find_technique("hbao+").converged);
      const double worst = largest_occlusion(raw_of("hbao+", frame, settings, {.math = Math::precise}));
      std::printf("hbao+, plane tilted by %.1f, bias %s: largest distance from open %.2g\n", tilt, bias, worst);
      // Without a bias nothing hides the rounding of depths: 6e-8 over the width of a pixel, 1/139.
      EXPECT_LE(worst, bias[1] == '\0' ? 2e-5 : 0);
    }
  }
}

}  // namespace
}  // namespace gloam::test::hbao_plus_test
