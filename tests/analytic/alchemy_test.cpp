// Alchemy and Scalable Ambient Obscurance against the integral that their samples estimate, over surfaces in closed form, and the
// effects of their parameters.
//
// With ever more samples the spiral tends to
//   AO = 1 - factor * strength * mean over screen directions and over distances t (pixels, uniform from 1 to the projected
//        radius P) of weight(v.v) max(0, v.n - bias) / (v.v + epsilon),
// v: from the point to the surface seen at distance t, in radii; alchemy: factor 2, weight 1 below 1; sao: factor 5, weight (1 -
// v.v)^3. The kernel differs from that by noise, which is measured, by float, and because it reads pixel centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/integral.h"

namespace gloam::test::alchemy_test {
namespace {

constexpr double radius = 0.8;
const RunOptions precise{.math = Math::precise};

/// Parameters of both; `bias` in depths.
struct Values {
  double strength = 0.5, bias = 1e-3, epsilon = 0.01;
};

Settings settings_of(const Values& values) {
  return {{"radius", fmt::format("{}", radius)},
          {"max_reach", "1"},
          {"strength", fmt::format("{}", values.strength)},
          {"bias", fmt::format("{}", values.bias)},
          {"epsilon", fmt::format("{}", values.epsilon)}};
}

double contribution(const std::string& technique, const Values& values, double height, double square, double bias) {
  if (square >= 1) return 0;
  const double over = std::max(0.0, height - bias) / (square + values.epsilon);
  return values.strength * over * (technique == "sao" ? 5 * std::pow(1 - square, 3) : 2);
}

/// By the midpoint rule.
Integral integral_of(const std::string& technique, const Values& values) {
  return [=](const IntegralCase& test, glm::ivec2 pixel) {
    const double reach = pixels_across(test.shot, radius, receiver_at(test, pixel).surface.depth);
    const auto in_radii = [&](const glm::dvec3& offset, const Surface& here) {
      const glm::dvec3 v = offset / radius;
      return contribution(technique, values, glm::dot(v, here.normal), glm::dot(v, v),
                          values.bias * here.depth / radius);
    };
    return 1 - mean_on_screen(test, pixel, 1, reach, 360, 600, in_radii);
  };
}

/// With a perspective and an orthographic camera that see the radius as 160 pixels.
void expect_integrals(const std::string& what, const Scene& scene, const std::vector<glm::ivec2>& pixels,
                      double bound) {
  for (const std::string technique : {"alchemy", "sao"}) {
    const Settings settings = joined(settings_of({}), find_technique(technique).converged);
    for (const Shot& shot : {perspective(440, 360, 30), orthographic(440, 360, 2.2)}) {
      const std::string camera = shot.camera.orthographic ? ", orthographic" : ", perspective";
      expect_integral({what + camera, shot, scene, pixels}, technique, settings, integral_of(technique, {}),
                      {.pixel = bound, .well_occluded = 0.97});
    }
  }
}

TEST(AlchemyIntegral, RightAngledCorner) {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({200 + 3 * i, 168 - 3 * i});
  expect_integrals("corner", corner(), pixels, 1e-3);
}

TEST(AlchemyIntegral, BallOverTiltedPlane) {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({220 + 92 + 2 * i, 172 + i});
  // Pixels on an outline are wholly on the ball or wholly off: 0.0021 of 0.05 at the worst pixel measured, a few pixels from the
  // ball with a radius of 160 pixels, and of either sign, so that the mean stays within 3e-4.
  const Scene scene = nearest_of({ball({0, 0, -3.9}, 0.4), tilted_plane(4, 0.4, 0.3)});
  expect_integrals("ball over a tilted plane", scene, pixels, 2e-3);
}

TEST(AlchemyIntegral, Plane) {
  for (const std::string technique : {"alchemy", "sao"}) {
    for (const double tilt : {0.0, 0.7, 1.3, 1.5}) {
      const Frame frame = shoot(perspective(160, 120), tilted_plane(3, tilt, 0.4));
      for (const double bias : {1e-4, 0.0}) {
        const double worst =
            largest_occlusion(raw_of(technique, frame, settings_of({.strength = 1, .bias = bias}), precise));
        std::printf("%s, plane tilted by %.1f, bias %g: largest distance from open %.2g\n", technique.c_str(), tilt,
                    bias, worst);
        // Without a bias nothing hides the rounding of depths: 6e-8 of 3.75 radii, times 5 / (v.v + 0.01) for the worst sample,
        // and half of that for the part above the plane.
        EXPECT_LE(worst, bias > 0 ? 0 : 5e-5);
      }
    }
  }
}

// --- Parameters

/// A plate parallel to the screen, `height` above a wall at depth 4; the receiver is beside it.
Scene plate_over_wall(double height) {
  return nearest_of({within(tilted_plane(4 - height, 0, 0), 0.2, 0.2), tilted_plane(4, 0, 0)});
}

constexpr glm::ivec2 beside_plate(94, 60);

double occlusion(const std::string& technique, double height, const Values& values, const Settings& more = {}) {
  const Settings settings = joined(joined(settings_of(values), more), {{"samples", "400"}});
  const Frame out = raw_of(technique, shoot(perspective(160, 120), plate_over_wall(height)), settings, precise);
  return 1.0 - raw_at(out, beside_plate.x, beside_plate.y);
}

TEST(AlchemyParameters, DoWhatTheySay) {
  for (const std::string technique : {"alchemy", "sao"}) {
    const Values values{.strength = 0.2, .bias = 0, .epsilon = 0.01};
    const double base = occlusion(technique, 0.3, values);
    ASSERT_GT(base, 0.02) << technique;
    ASSERT_LT(base, 0.4) << technique;
    EXPECT_NEAR(occlusion(technique, 0.3, {.strength = 0.4, .bias = 0}), 2 * base, 1e-5) << technique;
    EXPECT_NEAR(occlusion(technique, 0.3, values, {{"power", "3"}}), 1 - std::pow(1 - base, 3), 1e-5) << technique;
    EXPECT_LT(occlusion(technique, 0.3, {.strength = 0.2, .bias = 0, .epsilon = 0.5}), 0.8 * base) << technique;
    // The plate is 0.075 depths above the wall.
    EXPECT_GT(occlusion(technique, 0.3, {.strength = 0.2, .bias = 0.07}), 0) << technique;
    EXPECT_EQ(occlusion(technique, 0.3, {.strength = 0.2, .bias = 0.0751}), 0) << technique;
  }
}

/// Alchemy counts everything within the radius and nothing beyond; sao fades.
TEST(AlchemyParameters, TheRadiusIsALimit) {
  const Values values{.strength = 0.2, .bias = 0, .epsilon = 0.01};
  for (const std::string technique : {"alchemy", "sao"}) EXPECT_EQ(occlusion(technique, 0.81, values), 0) << technique;
  EXPECT_GT(occlusion("alchemy", 0.6, values), 0.01);
  EXPECT_GT(occlusion("sao", 0.6, values), 0);
  // Relative to alchemy: 5/2 (1 - v.v)^3, v.v being 0.56 and more of the squared radius.
  EXPECT_LT(occlusion("sao", 0.6, values), 2.5 * std::pow(1 - 0.56, 3) * occlusion("alchemy", 0.6, values));
}

}  // namespace
}  // namespace gloam::test::alchemy_test
