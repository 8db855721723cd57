// HBAO against the expectation of its own sweep, over surfaces known in closed form; and the effects of its parameters.
//
// With ever more directions the estimate of any number of steps tends to
//   AO = 1 - mean over screen directions and over shifts s of sum over k of W(|v_k|) max(0, h(v_k) - highest h so far),
// v_k: from the point to the surface seen at distance 1 + (s + k) (P - 1) / steps; h(v) = n.v/|v| (or its square), from the
// height of the bias on. The kernel differs from that by noise, which is measured, by float, and because it reads pixel centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/integral.h"
#include "support/long.h"

namespace gloam::test::hbao_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Method {
  double radius = 0.8, bias = 0.1;
  int steps = 9;
  std::string falloff = "quadratic", weighting = "uniform";
  Settings settings() const {
    return {{"radius", fmt::format("{}", radius)},
            {"bias", fmt::format("{}", bias)},
            {"steps", fmt::format("{}", steps)},
            {"falloff", falloff},
            {"weighting", weighting},
            {"directions", "32"}};
  }
  double height(double sine) const { return weighting == "cosine" ? sine * sine : sine; }
  double weight(double distance) const {
    const double t = distance / radius;
    if (t >= 1) return 0;
    return falloff == "none" ? 1 : falloff == "linear" ? 1 - t : 1 - t * t;
  }
};

/// By the midpoint rule.
double expectation(const Method& method, const IntegralCase& test, glm::ivec2 pixel) {
  constexpr int directions = 128;
  const int shifts = std::max(4, 128 / method.steps);
  const Receiver here = receiver_at(test, pixel);
  const double reach = pixels_across(test.shot, method.radius, here.surface.depth);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * pi * (d + 0.5) / directions;
    for (int s = 0; s < shifts; ++s) {
      double highest = method.height(std::sin(method.bias));
      for (int k = 0; k < method.steps; ++k) {
        const double t = 1 + ((s + 0.5) / shifts + k) * (reach - 1) / method.steps;
        const auto v = towards(test, here, {pixel.x + 0.5 + t * std::cos(angle), pixel.y + 0.5 + t * std::sin(angle)});
        if (!v) continue;
        const double height = method.height(std::max(0.0, glm::dot(here.surface.normal, *v) / glm::length(*v)));
        const double weight = method.weight(glm::length(*v));
        if (weight <= 0 || height <= highest) continue;
        sum += weight * (height - highest);
        highest = height;
      }
    }
  }
  return 1 - sum / (directions * shifts);
}

void expect_method(const IntegralCase& test, const Method& method) {
  expect_integral(named(test, fmt::format("{}, {}, {} steps", method.falloff, method.weighting, method.steps)), "hbao",
                  method.settings(),
                  [&](const IntegralCase& c, glm::ivec2 pixel) { return expectation(method, c, pixel); });
}

std::vector<Method> methods() {
  return {{.steps = 9},
          {.steps = 64},
          {.steps = 9, .falloff = "none"},
          {.steps = 9, .falloff = "linear"},
          {.steps = 9, .weighting = "cosine"},
          {.bias = 0.3, .steps = 32, .falloff = "none", .weighting = "cosine"}};
}

/// The upper wall steeper to the view than the lower one.
TEST(HbaoExpectation, Corner) {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 6; ++i) pixels.push_back({145 + 4 * i, 86 + 6 * i});
  for (const Method& method : methods()) {
    expect_method({"corner, perspective", perspective(320, 256), corner(1), pixels}, method);
    expect_method({"corner, orthographic", orthographic(320, 256, 4), corner(1), pixels}, method);
  }
}

TEST(HbaoExpectation, WavesOffTheCentre) {
  ONLY_IN_LONG_RUN();
  // Smooth everywhere: no outline between pixels, and horizons that rise in many small steps.
  const Scene waves = [](const EyeRay& ray) -> std::optional<Surface> {
    const auto height = [](double x, double y) { return -4 + 0.45 * std::sin(2.5 * x + 1) * std::cos(2 * y); };
    double depth = 4;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 p = point_at(ray, depth);
      depth += (p.z - height(p.x, p.y)) * 0.8;
    }
    const glm::dvec3 p = point_at(ray, depth);
    const double dx = 0.45 * 2.5 * std::cos(2.5 * p.x + 1) * std::cos(2 * p.y);
    const double dy = -0.45 * 2 * std::sin(2.5 * p.x + 1) * std::sin(2 * p.y);
    return Surface{depth, glm::normalize(glm::dvec3(-dx, -dy, 1))};
  };
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 6; ++i) pixels.push_back({210 + 5 * i, 170 - 4 * i});
  for (const Method& method : methods()) {
    if (method.bias > 0.2) continue;  // nothing here is that high
    Method flat = method;
    flat.bias = 0.02;
    if (method.weighting == "cosine") flat.falloff = "none";  // otherwise low hills occlude too little
    expect_method({"waves, perspective", perspective(320, 256), waves, pixels}, flat);
    expect_method({"waves, orthographic", orthographic(320, 256, 4), waves, pixels}, flat);
  }
}

/// The limit for many steps with a known horizon: beside a step, on a surface that faces the eye, half of all directions lead to
/// its edge.
TEST(Hbao, ConvergesToTheHorizonWithoutFalloff) {
  const double rise = 0.3, pixel = 4.0 / 480, radius = 0.8;
  const IntegralCase beside{"step", orthographic(480, 360, 4), step(rise), {{240 - 18, 180}}};
  for (const bool cosine : {false, true}) {
    const Settings settings = {{"radius", "0.8"},    {"bias", "0"},
                               {"falloff", "none"},  {"weighting", cosine ? "cosine" : "uniform"},
                               {"directions", "64"}, {"steps", "128"}};
    const double found = estimates(beside, "hbao", settings, 4)[0].mean;
    // The edge lies half a pixel beyond the last pixel before it.
    const double near = 18 * pixel - pixel / 2;
    double taken = 0;
    constexpr int azimuths = 4000;
    for (int i = 0; i < azimuths; ++i) {
      const double azimuth = -pi / 2 + pi * (i + 0.5) / azimuths, distance = near / std::cos(azimuth);
      const double slant = std::hypot(distance, rise), sine = rise / slant;
      if (slant < radius) taken += (cosine ? sine * sine : sine) / azimuths / 2;
    }
    std::printf("hbao, step, %s: closed form %.4f, found %.4f\n", cosine ? "cosine" : "uniform", 1 - taken, found);
    EXPECT_LT(taken, 0.5);
    EXPECT_GT(taken, 0.1);
    // A pixel is 1/18 of the distance: where a staircase of pixels replaces a straight edge, an error of second order remains.
    EXPECT_NEAR(found, 1 - taken, 4e-3);
  }
}

TEST(Hbao, AHigherBiasNeverDarkens) {
  const Frame frame = shoot(perspective(160, 120), room());
  Frame last = raw_of("hbao", frame, {{"bias", "0"}});
  for (const char* bias : {"0.1", "0.5", "1.2"}) {
    Frame next = raw_of("hbao", frame, {{"bias", bias}});
    int brighter = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        EXPECT_GE(raw_at(next, x, y), raw_at(last, x, y) - 1e-6f) << x << ", " << y << ", bias " << bias;
        brighter += raw_at(next, x, y) > raw_at(last, x, y) + 0.01f;
      }
    }
    EXPECT_GT(brighter, 160 * 120 / 20) << bias;
    last = std::move(next);
  }
}

/// A wall so high and near (2 pixels) that it takes nearly half: a quarter of the sphere is left, with its mean at 45 degrees.
TEST(HbaoBentNormal, BesideAWall) {
  const Frame out = open_directions_of(
      "hbao", shoot(orthographic(480, 360, 4), step(0.9)),
      {{"radius", "8"}, {"max_reach", "1"}, {"falloff", "none"}, {"directions", "64"}, {"steps", "128"}});
  const glm::dvec3 bent = vector_at(out, "bent_normal", 238, 180);
  EXPECT_NEAR(bent.x, -std::sqrt(0.5), 0.03);
  EXPECT_NEAR(bent.y, 0, 0.03);
  EXPECT_NEAR(bent.z, std::sqrt(0.5), 0.03);
  // (1 + cosine) / 2 is the mean's length, 1 / sqrt(2).
  EXPECT_NEAR(value_at(out, "cone", 238, 180), std::sqrt(2.0) - 1, 0.03);
}

}  // namespace
}  // namespace gloam::test::hbao_test
