// HBAO+ against the integral that its samples estimate, over surfaces known in closed form.
//
// With ever more directions and steps the estimate tends to
//   AO = 1 - 2 * mean over screen directions and over distances t (pixels, uniform from 1 to the projected radius P) of
//        W(|v|) max(0, n.v/|v| - bias),   W = max(0, 1 - v^2 / R^2),
// v going from the point to what is seen at distance t. The kernel differs from that by noise, which is measured, by
// float, and by looking at pixel centres: an error of second order in 1/P where the surface is smooth, of first order
// around outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double radius = 0.8, bias = 0.1;
constexpr int seeds = 12;

Plan plan_of(const Settings& settings) {
  PlanRequest request;
  request.outputs = {"hbao+"};
  request.then = "none";
  request.settings = settings;
  return make_plan(request, {"depth", "normal"}, "");
}

Plan converged_plan() {
  return plan_of({{"radius", fmt::format("{}", radius)},
                  {"bias", fmt::format("{}", bias)},
                  {"directions", "32"},
                  {"steps", "32"}});
}

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

/// The integral at the centre of a pixel, by midpoints.
double integral(const Shot& shot, const Scene& scene, int x, int y) {
  constexpr int directions = 360, steps = 600;
  const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
  const Surface here = scene(ray).value();
  const glm::dvec3 point = point_at(ray, here.depth);
  const double pixels = radius * shot.camera.fx / (shot.camera.orthographic ? 1 : here.depth);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * std::numbers::pi * (d + 0.5) / directions;
    for (int k = 0; k < steps; ++k) {
      const double t = 1 + (pixels - 1) * (k + 0.5) / steps;
      const EyeRay other = ray_through(shot, x + 0.5 + t * std::cos(angle), y + 0.5 + t * std::sin(angle));
      const auto seen = scene(other);
      if (!seen) continue;
      const glm::dvec3 v = point_at(other, seen->depth) - point;
      const double weight = std::max(0.0, 1 - glm::dot(v, v) / (radius * radius));
      sum += weight * std::max(0.0, glm::dot(here.normal, v) / glm::length(v) - bias);
    }
  }
  return std::clamp(1 - 2 * sum / (directions * steps), 0.0, 1.0);
}

/// Mean and standard error of that mean at one pixel, over seeds.
struct Estimate {
  double mean = 0, error = 0;
};

std::vector<Estimate> estimates(const Shot& shot, const Scene& scene, const std::vector<glm::ivec2>& pixels) {
  const Frame frame = shoot(shot, scene);
  const Plan plan = converged_plan();
  std::vector<double> sums(pixels.size()), squares(pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double value = out.views[0].find("ao_raw")->channels[0].at(pixels[i].x, pixels[i].y);
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  std::vector<Estimate> all;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double mean = sums[i] / seeds, variance = std::max(0.0, squares[i] / seeds - mean * mean);
    all.push_back({mean, std::sqrt(variance / (seeds - 1))});
  }
  return all;
}

/// What the estimate is off by, systematically (mean over pixels) and at one pixel.
void expect_integral(const char* what, const Shot& shot, const Scene& scene, const std::vector<glm::ivec2>& pixels) {
  const std::vector<Estimate> found = estimates(shot, scene, pixels);
  double bias_sum = 0, worst = 0, noise = 0, lowest = 1;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double expected = integral(shot, scene, pixels[i].x, pixels[i].y), off = found[i].mean - expected;
    bias_sum += off;
    noise += found[i].error * found[i].error;
    worst = std::max(worst, std::abs(off));
    lowest = std::min(lowest, expected);
    EXPECT_NEAR(found[i].mean, expected, 1e-3 + 4 * found[i].error)
        << what << " at " << pixels[i].x << ", " << pixels[i].y;
  }
  const double count = double(pixels.size()), mean = bias_sum / count;
  std::printf(
      "hbao+, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g, of which noise %.2g (standard error)\n",
      what, lowest, mean, worst, std::sqrt(noise / count));
  EXPECT_LT(lowest, 0.95) << "the case tests nothing";
  EXPECT_LE(std::abs(mean), 1e-3) << what;
}

/// What is nearer of two scenes.
Scene nearer_of(const Scene& a, const Scene& b) {
  return [=](const EyeRay& ray) {
    const auto first = a(ray), second = b(ray);
    if (!first || !second) return first ? first : second;
    return first->depth < second->depth ? first : second;
  };
}

TEST(HbaoPlusIntegral, Plane) {
  for (const double tilt : {0.0, 0.7, 1.3, 1.5}) {
    const Frame frame = shoot(perspective(160, 120), tilted_plane(3, tilt, 0.4));
    for (const char* bias : {"0.1", "0"}) {
      const Plan plan = plan_of({{"bias", bias}, {"directions", "32"}, {"steps", "32"}});
      const Frame out = run(plan, frame, device(), {.math = Math::precise}).frame;
      const Difference d = difference(*out.views[0].find("ao_raw"), Plane{"ao_raw", [&] {
                                                                            std::vector<Channel> ones;
                                                                            ones.emplace_back(Layout(160, 120), 1.0f);
                                                                            return ones;
                                                                          }()});
      std::printf("hbao+, plane tilted by %.1f, bias %s: largest distance from open %.2g\n", tilt, bias, d.max);
      // Without a bias nothing is left to swallow the rounding of depths: 6e-8 over the width of a pixel, 1/139.
      EXPECT_LE(d.max, bias[1] == '\0' ? 2e-5 : 0);
    }
  }
}

TEST(HbaoPlusIntegral, RightAngledCorner) {
  // Two walls at 45 degrees to the view axis that meet in a line across the image.
  const double quarter = std::numbers::pi / 4;
  const Scene corner =
      nearer_of(tilted_plane(4, quarter, std::numbers::pi / 2), tilted_plane(4, quarter, -std::numbers::pi / 2));
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({200 + 3 * i, 121 + 4 * i});
  expect_integral("corner, perspective", perspective(440, 360), corner, pixels);
  expect_integral("corner, orthographic", orthographic(440, 360, 4), corner, pixels);
}

TEST(HbaoPlusIntegral, BallOverPlane) {
  const glm::dvec3 centre(0, 0, -3.6);
  const double ball_radius = 0.35;
  const Scene ball = [=](const EyeRay& ray) -> std::optional<Surface> {
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.direction, ray.origin - centre);
    const double c = glm::dot(ray.origin - centre, ray.origin - centre) - ball_radius * ball_radius,
                 root = b * b - a * c;
    if (root < 0) return {};
    const double depth = (-b - std::sqrt(root)) / a;
    return Surface{depth, glm::normalize(point_at(ray, depth) - centre)};
  };
  const Scene scene = nearer_of(ball, tilted_plane(4, 0, 0));
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({220 + 42 + 2 * i, 180 + i});
  expect_integral("ball over a plane, perspective", perspective(440, 360), scene, pixels);
  expect_integral("ball over a plane, orthographic", orthographic(440, 360, 4), scene, pixels);
}

}  // namespace
}  // namespace gloam::test
