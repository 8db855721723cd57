#include "support/integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gloam::test {
namespace {

/// Mean and standard error of that mean at one pixel, over seeds.
struct Estimate {
  double mean = 0, error = 0;
};

std::vector<Estimate> estimates(const IntegralCase& test, const std::string& technique, const Settings& settings,
                                int seeds) {
  const Frame frame = shoot(test.shot, test.scene);
  PlanRequest request{.outputs = {technique}, .only = {"ao_raw"}, .then = "none", .settings = settings};
  const Plan plan = make_plan(request, {"depth", "normal"}, "");
  std::vector<double> sums(test.pixels.size()), squares(test.pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame;
    for (size_t i = 0; i < test.pixels.size(); ++i) {
      const double value = out.views[0].find("ao_raw")->channels[0].at(test.pixels[i].x, test.pixels[i].y);
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  std::vector<Estimate> all;
  for (size_t i = 0; i < test.pixels.size(); ++i) {
    const double mean = sums[i] / seeds, variance = std::max(0.0, squares[i] / seeds - mean * mean);
    all.push_back({mean, std::sqrt(variance / (seeds - 1))});
  }
  return all;
}

/// Two walls at 45 degrees to the view axis that meet in a line across the image.
Scene corner() {
  const double quarter = std::numbers::pi / 4;
  return nearer_of(tilted_plane(4, quarter, std::numbers::pi / 2), tilted_plane(4, quarter, -std::numbers::pi / 2));
}

}  // namespace

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

Scene nearer_of(const Scene& a, const Scene& b) {
  return [=](const EyeRay& ray) {
    const auto first = a(ray), second = b(ray);
    if (!first || !second) return first ? first : second;
    return first->depth < second->depth ? first : second;
  };
}

Scene ball(const glm::dvec3& centre, double radius) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const glm::dvec3 from = ray.origin - centre;
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.direction, from);
    const double root = b * b - a * (glm::dot(from, from) - radius * radius);
    if (root < 0) return {};
    const double depth = (-b - std::sqrt(root)) / a;
    return Surface{depth, glm::normalize(point_at(ray, depth) - centre)};
  };
}

std::vector<IntegralCase> integral_cases() {
  std::vector<glm::ivec2> on_the_wall, beside_the_ball;
  for (int i = 0; i < 14; ++i) on_the_wall.push_back({200 + 3 * i, 121 + 4 * i});
  for (int i = 0; i < 14; ++i) beside_the_ball.push_back({220 + 42 + 2 * i, 180 + i});
  const Scene over_plane = nearer_of(ball({0, 0, -3.6}, 0.35), tilted_plane(4, 0, 0));
  return {{"corner, perspective", perspective(440, 360), corner(), on_the_wall},
          {"corner, orthographic", orthographic(440, 360, 4), corner(), on_the_wall},
          {"ball over a plane, perspective", perspective(440, 360), over_plane, beside_the_ball},
          {"ball over a plane, orthographic", orthographic(440, 360, 4), over_plane, beside_the_ball}};
}

void expect_integral(const IntegralCase& test, const std::string& technique, const Settings& settings,
                     const Integral& integral, double bound, int seeds) {
  const std::vector<Estimate> found = estimates(test, technique, settings, seeds);
  double sum = 0, worst = 0, noise = 0, lowest = 1;
  for (size_t i = 0; i < test.pixels.size(); ++i) {
    const double expected = integral(test, test.pixels[i]), off = found[i].mean - expected;
    sum += off;
    noise += found[i].error * found[i].error;
    worst = std::max(worst, std::abs(off));
    lowest = std::min(lowest, expected);
    EXPECT_NEAR(found[i].mean, expected, 2 * bound + 4 * found[i].error)
        << test.name << " at " << test.pixels[i].x << ", " << test.pixels[i].y;
  }
  const double count = double(test.pixels.size()), mean = sum / count;
  std::printf(
      "%s, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g, of which noise %.2g (standard error)\n",
      technique.c_str(), test.name.c_str(), lowest, mean, worst, std::sqrt(noise / count));
  EXPECT_LT(lowest, 0.95) << test.name << ": the case tests nothing";
  EXPECT_LE(std::abs(mean), bound + 2 * std::sqrt(noise) / count) << test.name;
}

}  // namespace gloam::test
