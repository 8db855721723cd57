// SSAO against the integral that its points estimate, over surfaces in closed form: the share of a half ball, ball or shell about
// the point that lies behind what the screen shows. The kernel reads pixel centres: an error of second order on smooth surfaces
// and of first order around outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/integral.h"
#include "support/long.h"

namespace gloam::test::ssao_test {
namespace {

constexpr double radius = 0.8;

struct Model {
  bool hemisphere = true;
  double inner = 0, bias = 0.02, range = 2;
};

Settings settings_of(const Model& m) {
  return {{"radius", fmt::format("{}", radius)},       {"samples", "1024"},
          {"hemisphere", m.hemisphere ? "on" : "off"}, {"inner", fmt::format("{}", m.inner)},
          {"bias", fmt::format("{}", m.bias)},         {"range", fmt::format("{}", m.range)}};
}

/// 1 if a point, `offset` from the surface, lies behind the visible surface in its direction; less if that is far before it.
double occlusion_at(const IntegralCase& test, const Receiver& here, const glm::dvec3& offset, const Model& m) {
  const glm::dvec3 point = here.point + offset;
  const glm::dvec2 place = pixel_of(test.shot, point);
  const EyeRay ray = ray_through(test.shot, place.x, place.y);
  const auto seen = test.scene(ray);
  if (!seen) return 0;
  // Lifted by the bias, along the ray.
  const double lift = m.hemisphere ? m.bias * glm::length(offset) : 0;
  const double depth = -point.z + lift / glm::dot(here.surface.normal, ray.direction);
  const double before = (here.surface.depth - seen->depth) / (m.range * radius);
  return seen->depth < depth ? std::clamp(2 - before, 0.0, 1.0) : 0;
}

double integral(const IntegralCase& test, glm::ivec2 pixel, const Model& m) {
  constexpr int points = 400000;
  const Receiver here = receiver_at(test, pixel);
  const double kept = 1 - m.inner * m.inner * m.inner;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 u = even_point(i);
    const double z = 2 * u.x - 1, level = std::sqrt(1 - z * z), turn = 2 * std::numbers::pi * u.y;
    glm::dvec3 offset =
        radius * std::cbrt(1 - kept * u.z) * glm::dvec3(level * std::cos(turn), level * std::sin(turn), z);
    if (m.hemisphere && glm::dot(offset, here.surface.normal) < 0) offset = -offset;
    sum += occlusion_at(test, here, offset, m);
  }
  return 1 - sum / points;
}

void expect_model(const IntegralCase& test, const Model& model) {
  expect_integral(test, "ssao", settings_of(model),
                  [&](const IntegralCase& c, glm::ivec2 pixel) { return integral(c, pixel, model); });
}

TEST(SsaoIntegral, CornerAndBall) {
  for (const IntegralCase& test : integral_cases()) expect_model(test, {});
}

TEST(SsaoIntegral, OtherSettings) {
  ONLY_IN_LONG_RUN();
  const IntegralCase corner = integral_case("corner, perspective"),
                     ball = integral_case("ball over a plane, perspective");
  expect_model(named(corner, "shell"), {.inner = 0.8});
  expect_model(named(ball, "whole ball"), {.hemisphere = false});
  expect_model(named(ball, "no bias, short range"), {.bias = 0, .range = 0.6});
}

/// As in the paper: half of the ball lies behind a plane. Half of a pixel's points lie above it, half below.
TEST(SsaoPlane, ReadsAHalfInTheWholeBall) {
  for (const double tilt : {0.0, 0.5, 0.95}) {
    const Frame frame = shoot(perspective(93, 61), tilted_plane(3, tilt, 0.4));
    const Frame out = raw_of("ssao", frame, {{"hemisphere", "off"}, {"range", "inf"}});
    for (int y = 0; y < 61; ++y) {
      for (int x = 0; x < 93; ++x) {
        EXPECT_NEAR(raw_at(out, x, y), 0.5, 1e-6) << tilt << ": " << x << ", " << y;
      }
    }
  }
}

/// Beside a wall the mean open direction leans away from it and the cone is narrower than the hemisphere.
TEST(SsaoDirections, LeanAwayFromAWall) {
  const Shot shot = perspective(160, 120);
  const Frame folded = open_directions_of("ssao", shoot(shot, corner()), {{"samples", "512"}});
  // Just above the line where the walls meet: the wall there faces down and to the eye, the bent normal leans to the eye.
  const glm::dvec3 wall = corner()(ray_through(shot, 80.5, 57.5))->normal;
  EXPECT_GT(vector_at(folded, "bent_normal", 80, 57).z, wall.z + 0.1);
  EXPECT_GT(value_at(folded, "cone", 80, 57), 0.1);
}

}  // namespace
}  // namespace gloam::test::ssao_test
