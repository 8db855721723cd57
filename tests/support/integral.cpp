#include "support/integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "gloam/normalise.h"
#include "gloam/projection.h"
#include "support/depth_layers.h"

namespace gloam::test {
namespace {

/// The same camera with its image moved.
IntegralCase moved(IntegralCase test, glm::ivec2 by) {
  test.shot.camera.cx += by.x;
  test.shot.camera.cy += by.y;
  for (glm::ivec2& pixel : test.pixels) pixel += by;
  return test;
}

/// A frame with the depth as a layer and background everywhere but at these pixels.
Frame only_at(const std::vector<glm::ivec2>& pixels, const Frame& frame) {
  Frame few = with_layers(frame, {same_depth});
  Channel& depth = plane_of(few, "depth").channels[0];
  for (int y = 0; y < few.height(); ++y) {
    for (int x = 0; x < few.width(); ++x) depth.at(x, y) = std::numeric_limits<float>::infinity();
  }
  for (const glm::ivec2& p : pixels) depth.at(p.x, p.y) = value_at(frame, "depth", p.x, p.y);
  normalise(few);
  return few;
}

std::vector<double> values_at(const std::vector<glm::ivec2>& pixels, const Frame& result) {
  std::vector<double> values;
  for (const glm::ivec2& p : pixels) values.push_back(raw_at(result, p.x, p.y));
  return values;
}

/// Indexed by seed and pixel.
using Samples = std::vector<std::vector<double>>;

Samples samples_of(const Plan& plan, const Frame& frame, const std::vector<glm::ivec2>& pixels, int seeds) {
  Samples samples;
  for (int seed = 0; seed < seeds; ++seed)
    samples.push_back(values_at(pixels, run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame));
  return samples;
}

Samples samples_of(const IntegralCase& test, const std::string& technique, const Settings& settings, int seeds) {
  const Frame frame = shoot(test.shot, test.scene);
  const std::vector<std::string> names = technique_names();
  if (std::find(names.begin(), names.end(), "dp-" + technique) == names.end())
    return samples_of(plan_of(technique, frame, settings), frame, test.pixels, seeds);
  const Frame few = only_at(test.pixels, frame);
  const Samples samples = samples_of(plan_of("dp-" + technique, few, settings), few, test.pixels, seeds);
  const Frame whole = raw_of(technique, frame, settings, {.math = Math::precise, .seed = seeds - 1});
  EXPECT_EQ(values_at(test.pixels, whole), samples.back())
      << technique << ", " << test.name << ": dp-" << technique << " over the depth as its layer differs";
  return samples;
}

Estimate estimate_of(const Samples& samples, size_t pixel) {
  const double count = double(samples.size());
  double sum = 0, squares = 0;
  for (const std::vector<double>& values : samples) sum += values[pixel];
  for (const std::vector<double>& values : samples) squares += std::pow(values[pixel] - sum / count, 2);
  return {sum / count, std::sqrt(squares / count / (count - 1))};
}

}  // namespace

std::vector<IntegralCase> integral_cases(int pixels) {
  std::vector<glm::ivec2> on_the_wall, beside_the_ball;
  for (int i = 0; i < pixels; ++i) {
    on_the_wall.push_back({200 + 42 / pixels * i, 121 + 60 / pixels * i});
    beside_the_ball.push_back({220 + 42 + 30 / pixels * i, 180 + 15 / pixels * i});
  }
  const Scene over_plane = nearest_of({ball({0, 0, -3.6}, 0.35), tilted_plane(4, 0, 0)});
  const Shot straight = perspective(440, 360), parallel = orthographic(440, 360, 4);
  return {{"corner, perspective", straight, corner(), on_the_wall},
          {"corner, orthographic", parallel, corner(), on_the_wall},
          moved({"corner, off-axis", straight, corner(), on_the_wall}, {90, -30}),
          {"ball over a plane, perspective", straight, over_plane, beside_the_ball},
          {"ball over a plane, orthographic", parallel, over_plane, beside_the_ball}};
}

IntegralCase integral_case(const std::string& name, int pixels) {
  for (const IntegralCase& test : integral_cases(pixels)) {
    if (test.name == name) return test;
  }
  throw std::out_of_range(name);
}

IntegralCase named(IntegralCase test, const std::string& more) {
  test.name += ", " + more;
  return test;
}

Receiver receiver_at(const IntegralCase& test, glm::ivec2 pixel) {
  const EyeRay ray = ray_through(test.shot, pixel.x + 0.5, pixel.y + 0.5);
  const Surface here = test.scene(ray).value();
  return {ray, here, point_at(ray, here.depth)};
}

std::optional<glm::dvec3> towards(const IntegralCase& test, const Receiver& receiver, glm::dvec2 place) {
  const EyeRay ray = ray_through(test.shot, place.x, place.y);
  const std::optional<Surface> seen = test.scene(ray);
  if (!seen) return {};
  return point_at(ray, seen->depth) - receiver.point;
}

double pixels_across(const Shot& shot, double length, double depth) {
  return length * shot.camera.fx / (shot.camera.orthographic ? 1 : depth);
}

glm::dvec2 pixel_of(const Shot& shot, const glm::dvec3& point) {
  if (shot.camera.slits)
    return gloam::pixel_of(shot.camera, point).value_or(glm::dvec2(std::numeric_limits<double>::quiet_NaN()));
  const double nearness = shot.camera.orthographic ? 1 : -1 / point.z;
  return {shot.camera.cx + point.x * nearness * shot.camera.fx, shot.camera.cy - point.y * nearness * shot.camera.fy};
}

glm::dvec3 even_point(int i) {
  return glm::fract(0.5 + double(i) * glm::dvec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703));
}

Contribution obscurance(double radius, double bias) {
  return [=](const glm::dvec3& v, const Surface& here) {
    const double weight = std::max(0.0, 1 - glm::dot(v, v) / (radius * radius));
    return weight * std::max(0.0, glm::dot(here.normal, v) / glm::length(v) - bias);
  };
}

double mean_on_screen(const IntegralCase& test, glm::ivec2 pixel, double from, double to, int directions, int distances,
                      const Contribution& contribution) {
  const Receiver here = receiver_at(test, pixel);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * std::numbers::pi * (d + 0.5) / directions;
    for (int k = 0; k < distances; ++k) {
      const double t = from + (to - from) * (k + 0.5) / distances;
      const auto v = towards(test, here, {pixel.x + 0.5 + t * std::cos(angle), pixel.y + 0.5 + t * std::sin(angle)});
      if (v) sum += contribution(*v, here.surface);
    }
  }
  return sum / (directions * distances);
}

std::vector<Estimate> estimates(const IntegralCase& test, const std::string& technique, const Settings& settings,
                                int seeds) {
  const Samples samples = samples_of(test, technique, settings, seeds);
  std::vector<Estimate> all;
  for (size_t i = 0; i < test.pixels.size(); ++i) all.push_back(estimate_of(samples, i));
  return all;
}

void expect_integral(const IntegralCase& test, const std::string& technique, const Settings& settings,
                     const Integral& integral, const Bounds& bounds, int seeds) {
  const std::vector<Estimate> found = estimates(test, technique, settings, seeds);
  const double count = double(test.pixels.size());
  double mean = 0, worst = 0, noise = 0, lowest = 1;
  for (size_t i = 0; i < test.pixels.size(); ++i) {
    const double expected = integral(test, test.pixels[i]), off = found[i].mean - expected;
    mean += off / count;
    noise += found[i].error * found[i].error / count;
    worst = std::max(worst, std::abs(off));
    lowest = std::min(lowest, expected);
    EXPECT_GT(expected, 0.05) << technique << ", " << test.name << ": clamped, so nothing is compared";
    EXPECT_NEAR(found[i].mean, expected, bounds.pixel + bounds.errors * found[i].error)
        << technique << ", " << test.name << " at " << test.pixels[i].x << ", " << test.pixels[i].y;
  }
  std::printf("%s, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g, of which noise %.2g\n",
              technique.c_str(), test.name.c_str(), lowest, mean, worst, std::sqrt(noise));
  EXPECT_LT(lowest, bounds.well_occluded) << technique << ", " << test.name << ": the case tests nothing";
  EXPECT_LE(std::abs(mean), bounds.mean) << technique << ", " << test.name;
}

}  // namespace gloam::test
