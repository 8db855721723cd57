// Multi-resolution AO against the expectation of what each resolution finds, over surfaces known in closed form.
//
// With ever more samples level i tends to A_i = mean over screen directions and over distances in its ring (pixels of the
// whole image, uniform) of W(|v|) max(0, n.v/|v| - bias), and the result to 1 - 2 max A_i, or to
// (1 - max A_i) (1 - mean A_i) over the levels whose rings the radius reaches. The kernel differs from that by noise, which
// is measured, by looking at pixel centres of each level, and by interpolation between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double pi = std::numbers::pi, radius = 0.8, bias = 0.1, max_reach = 0.25;
constexpr int levels = 3;

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

Plan plan_of(const Settings& settings, const std::string& then = "none", int resolution = 1) {
  return make_plan({.outputs = {"multires"}, .then = then, .settings = settings, .resolution = resolution},
                   {"depth", "normal"}, "");
}

float raw_at(const Frame& result, int x, int y) { return result.views[0].find("ao_raw")->channels[0].at(x, y); }

/// A_i at the centre of a pixel, by midpoints.
double obscurance_in_ring(const Shot& shot, const Scene& scene, int x, int y, double from, double to) {
  constexpr int directions = 240, steps = 160;
  const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
  const Surface here = scene(ray).value();
  const glm::dvec3 point = point_at(ray, here.depth);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * pi * (d + 0.5) / directions;
    for (int k = 0; k < steps; ++k) {
      const double t = from + (to - from) * (k + 0.5) / steps;
      const EyeRay other = ray_through(shot, x + 0.5 + t * std::cos(angle), y + 0.5 + t * std::sin(angle));
      const auto seen = scene(other);
      if (!seen) continue;
      const glm::dvec3 v = point_at(other, seen->depth) - point;
      const double weight = std::max(0.0, 1 - glm::dot(v, v) / (radius * radius));
      sum += weight * std::max(0.0, glm::dot(here.normal, v) / glm::length(v) - bias);
    }
  }
  return sum / (directions * steps);
}

struct Expected {
  double maximum, maximum_and_mean;
};

Expected expected_at(const Shot& shot, const Scene& scene, int x, int y) {
  const double depth = scene(ray_through(shot, x + 0.5, y + 0.5))->depth;
  const double most_pixels = max_reach * shot.width;
  const double reach = std::min(most_pixels, radius * shot.camera.fx / (shot.camera.orthographic ? 1 : depth));
  double most = 0, sum = 0;
  int count = 0;
  for (int level = 0; level < levels; ++level) {
    const double outer = most_pixels / double(1 << (levels - 1 - level)), from = level == 0 ? 1 : outer / 2;
    if (reach <= from) continue;
    const double found = obscurance_in_ring(shot, scene, x, y, from, std::min(reach, outer));
    most = std::max(most, found);
    sum += found;
    ++count;
  }
  return {1 - 2 * most, (1 - most) * (1 - sum / count)};
}

void expect_expectation(const std::string& what, const Shot& shot, const Scene& scene,
                        const std::vector<glm::ivec2>& pixels, double bound) {
  constexpr int seeds = 6;
  const Frame frame = shoot(shot, scene);
  for (const bool with_mean : {false, true}) {
    const Plan plan = plan_of({{"radius", fmt::format("{}", radius)},
                               {"levels", fmt::format("{}", levels)},
                               {"samples", "512"},
                               {"combine", with_mean ? "maximum_and_mean" : "maximum"}});
    std::vector<double> found(pixels.size());
    for (int seed = 0; seed < seeds; ++seed) {
      const Frame out = run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame;
      for (size_t i = 0; i < pixels.size(); ++i) found[i] += raw_at(out, pixels[i].x, pixels[i].y) / seeds;
    }
    double mean = 0, worst = 0, lowest = 1;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const Expected all = expected_at(shot, scene, pixels[i].x, pixels[i].y);
      const double expected = with_mean ? all.maximum_and_mean : all.maximum, off = found[i] - expected;
      EXPECT_NEAR(found[i], expected, bound) << what << " at " << pixels[i].x << ", " << pixels[i].y;
      mean += off / double(pixels.size());
      worst = std::max(worst, std::abs(off));
      lowest = std::min(lowest, expected);
    }
    std::printf("multires, %s, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g\n", what.c_str(),
                with_mean ? "maximum and mean" : "maximum", lowest, mean, worst);
    EXPECT_LT(lowest, 0.95) << what << ": the case tests nothing";
    EXPECT_LE(std::abs(mean), 1e-3) << what;
  }
}

/// Two walls that meet in a line across the image, one of them steeper to the view than the other.
Scene corner() {
  const Scene a = tilted_plane(4, pi / 4, pi / 2), b = tilted_plane(4, 1.0, -pi / 2);
  return [=](const EyeRay& ray) {
    const auto first = a(ray), second = b(ray);
    if (!first || !second) return first ? first : second;
    return first->depth < second->depth ? first : second;
  };
}

/// Pixels that all levels have, so that nothing is interpolated; the levels' own pixels are up to 4 wide.
TEST(MultiresExpectation, PixelsOfAllLevels) {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 8; ++i) pixels.push_back({240 + 8 * i, 112 + 8 * i});
  expect_expectation("corner, perspective", perspective(480, 360), corner(), pixels, 1e-3);
  expect_expectation("corner, orthographic", orthographic(480, 360, 4), corner(), pixels, 1e-3);
}

/// Pixels between: the upsampled part is a straight line between pixels that are 4 apart, which cuts where the obscurance
/// of a ring bends: at the distance where the wall comes into the ring. There it is off by up to 5e-3 (measured: see what
/// is printed); twice the resolution leaves less of it, and the mean over pixels is within 1e-3.
TEST(MultiresExpectation, PixelsBetween) {
  std::vector<glm::ivec2> pixels, finer;
  for (int i = 0; i < 8; ++i) pixels.push_back({243 + 7 * i, 125 + 5 * i});
  for (const glm::ivec2& p : pixels) finer.push_back({2 * p.x + 1, 2 * p.y + 1});
  expect_expectation("corner, perspective, between", perspective(480, 360), corner(), pixels, 6e-3);
  expect_expectation("corner, orthographic, between", orthographic(480, 360, 4), corner(), pixels, 6e-3);
  expect_expectation("corner, orthographic, between, finer", orthographic(960, 720, 4), corner(), finer, 3e-3);
}

/// Where the radius ends within the finest ring, coarser levels are of no matter.
TEST(Multires, LevelsBeyondTheRadiusChangeNothing) {
  for (const Shot& shot : {perspective(320, 240), orthographic(320, 240, 4)}) {
    const Frame frame = shoot(shot, room());
    for (const int lanes : usual_lanes(device())) {
      for (const char* combine : {"maximum", "maximum_and_mean"}) {
        const auto with_levels = [&](const char* count) {
          const Settings settings = {{"radius", "0.07"}, {"samples", "4"}, {"levels", count}, {"combine", combine}};
          return run(plan_of(settings), frame, device(), {.lanes = lanes}).frame;
        };
        // 0.07 is at most 20 pixels, where the finest of three rings ends, and at least 5, where that of five does.
        EXPECT_TRUE(same_bits(with_levels("1"), with_levels("3"))) << "lanes " << lanes << ", " << combine;
        EXPECT_FALSE(same_bits(with_levels("1"), with_levels("5"))) << "lanes " << lanes << ", " << combine;
      }
    }
  }
}

/// The radius is covered without gaps: a thin ridge darkens the floor beside it at every distance below the radius, and
/// not beyond.
TEST(Multires, NoDistanceIsMissed) {
  constexpr double height = 0.3;
  const Scene ridge = [](const EyeRay& ray) -> std::optional<Surface> {
    return Surface{std::abs(ray.origin.x) < 0.02 ? 4 - height : 4.0, {0, 0, 1}};
  };
  const Shot shot = orthographic(480, 120, 4);
  const Frame frame = shoot(shot, ridge);
  const Frame out = run(plan_of({{"radius", "0.8"}, {"samples", "512"}, {"falloff", "none"}, {"bias", "0"}}), frame,
                        device(), {.math = Math::precise})
                        .frame;
  const double pixel = 4.0 / 480;
  for (int x = 246; x < 480; ++x) {
    const double distance = (x + 0.5 - 240) * pixel - 0.02;
    if (std::hypot(distance, height) < 0.8 - 5 * pixel) {
      EXPECT_LT(raw_at(out, x, 60), 0.995) << x;
    }
    if (std::hypot(distance, height) > 0.8 + 8 * pixel) {
      EXPECT_EQ(raw_at(out, x, 60), 1) << x;
    }
  }
}

/// Scales multiply: at half the resolution the levels are halves of halves.
TEST(Multires, RunsAtALowerResolution) {
  const Frame frame = shoot(perspective(640, 480), room());
  for (const char* combine : {"maximum", "maximum_and_mean"}) {
    const Settings settings = {{"samples", "256"}, {"combine", combine}};
    const Frame whole = run(plan_of(settings, ""), frame, device(), {}).frame;
    for (const int resolution : {2, 4}) {
      const Frame reduced = run(plan_of(settings, "", resolution), frame, device(), {}).frame;
      const Difference d = difference(*whole.views[0].find("ao"), *reduced.views[0].find("ao"));
      std::printf("multires, %s at 1/%d: mean difference %.2g\n", combine, resolution, d.mean);
      EXPECT_GT(d.mean, 0);
      EXPECT_LT(d.mean, 0.004 * resolution);
    }
  }
}

}  // namespace
}  // namespace gloam::test
