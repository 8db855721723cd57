// Volumetric obscurance against the integral that its columns estimate, over surfaces known in closed form: over the disk
// about the line to the eye, how much of each column of the half ball lies below what the screen shows there, to how long
// the columns are. The kernel looks at pixel centres, which is an error of second order where a surface is smooth and of
// first order around outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double radius = 0.8;
constexpr int seeds = 10;

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

/// The pixel (continuous) that shows a point.
glm::dvec2 pixel_of(const Shot& shot, const glm::dvec3& point) {
  const double nearness = shot.camera.orthographic ? 1 : -1 / point.z;
  return {shot.camera.cx + point.x * nearness * shot.camera.fx, shot.camera.cy - point.y * nearness * shot.camera.fy};
}

Frame raw_of(const std::string& technique, const Frame& frame, const Settings& settings, const RunOptions& options) {
  PlanRequest request{.outputs = {technique}, .only = {"ao_raw"}, .then = "none", .settings = settings};
  return run(make_plan(request, plane_names(frame), "this frame"), frame, device(), options).frame;
}

float raw_at(const Frame& result, int x, int y) { return result.views[0].find("ao_raw")->channels[0].at(x, y); }

/// Points of the unit cube, even in it (Roberts 2018).
glm::dvec3 even(int i) {
  return glm::fract(0.5 + double(i) * glm::dvec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703));
}

struct Model {
  double bias = 0.02, range = 2;
};

Settings settings_of(const Model& m) {
  return {{"radius", fmt::format("{}", radius)},
          {"samples", "1024"},
          {"bias", fmt::format("{}", m.bias)},
          {"range", fmt::format("{}", m.range)}};
}

double integral(const Shot& shot, const Scene& scene, int x, int y, const Model& m) {
  constexpr int points = 200000;
  const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
  const Surface here = scene(ray).value();
  const glm::dvec3 point = point_at(ray, here.depth), to_eye = -glm::normalize(ray.direction);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), to_eye)), up = glm::cross(to_eye, right);
  const double facing = glm::dot(here.normal, to_eye);
  double occluded = 0, whole = 0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 u = even(i);
    const double distance = std::sqrt(u.x), turn = 2 * std::numbers::pi * u.y;
    const glm::dvec3 aside = radius * distance * (std::cos(turn) * right + std::sin(turn) * up);
    const double middle = glm::dot(here.normal, aside), rise = radius * std::sqrt(1 - u.x) * facing;
    const double low = std::max(0.0, middle - rise), high = std::max(0.0, middle + rise);
    whole += high - low;
    // Where the column passes the depth of the point.
    const glm::dvec2 pixel = pixel_of(shot, point + aside - to_eye * (aside.z / to_eye.z));
    const EyeRay other = ray_through(shot, pixel.x, pixel.y);
    const auto seen = scene(other);
    if (!seen) continue;
    const double height = glm::dot(here.normal, point_at(other, seen->depth) - point) - m.bias * distance * radius;
    const double before = (here.depth - seen->depth) / (m.range * radius);
    occluded += (std::clamp(height, low, high) - low) * std::clamp(2 - before, 0.0, 1.0);
  }
  return 1 - occluded / whole;
}

/// The mean of the converged estimate over seeds against the integral, at each pixel.
void expect_integral(const char* what, const Shot& shot, const Scene& scene, const std::vector<glm::ivec2>& pixels,
                     const Model& model = {}) {
  const Frame frame = shoot(shot, scene);
  std::vector<double> sums(pixels.size()), squares(pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = raw_of("volumetric", frame, settings_of(model), {.math = Math::precise, .seed = seed});
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double value = raw_at(out, pixels[i].x, pixels[i].y);
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  double sum = 0, worst = 0, lowest = 1;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double mean = sums[i] / seeds, variance = std::max(0.0, squares[i] / seeds - mean * mean);
    const double expected = integral(shot, scene, pixels[i].x, pixels[i].y, model);
    sum += mean - expected;
    worst = std::max(worst, std::abs(mean - expected));
    lowest = std::min(lowest, expected);
    EXPECT_NEAR(mean, expected, 1e-3 + 4 * std::sqrt(variance / (seeds - 1)))
        << what << " at " << pixels[i].x << ", " << pixels[i].y;
  }
  const double mean = sum / double(pixels.size());
  std::printf("volumetric, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g\n", what, lowest, mean,
              worst);
  EXPECT_LT(lowest, 0.95) << "the case tests nothing";
  EXPECT_LE(std::abs(mean), 1e-3) << what;
}

/// What is nearest of several scenes.
Scene nearest_of(const std::vector<Scene>& scenes) {
  return [=](const EyeRay& ray) {
    std::optional<Surface> nearest;
    for (const Scene& scene : scenes) {
      const auto seen = scene(ray);
      if (seen && (!nearest || seen->depth < nearest->depth)) nearest = seen;
    }
    return nearest;
  };
}

/// Two walls at 45 degrees to the view axis that meet in a line across the image.
Scene corner() {
  const double quarter = std::numbers::pi / 4, half = std::numbers::pi / 2;
  return nearest_of({tilted_plane(4, quarter, half), tilted_plane(4, quarter, -half)});
}

Scene ball_over_plane() {
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
  return nearest_of({ball, tilted_plane(4, 0, 0)});
}

std::vector<glm::ivec2> in_the_corner() {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 6; ++i) pixels.push_back({200 + 7 * i, 121 + 10 * i});
  return pixels;
}

std::vector<glm::ivec2> beside_the_ball() {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 6; ++i) pixels.push_back({220 + 42 + 5 * i, 180 + 2 * i});
  return pixels;
}

TEST(VolumetricIntegral, Corner) {
  expect_integral("corner, perspective", perspective(440, 360), corner(), in_the_corner());
  expect_integral("corner, orthographic", orthographic(440, 360, 4), corner(), in_the_corner());
  Shot off_axis = perspective(440, 360);
  off_axis.camera.cx += 90;
  off_axis.camera.cy -= 30;
  std::vector<glm::ivec2> pixels = in_the_corner();
  for (glm::ivec2& p : pixels) p += glm::ivec2(90, -30);
  expect_integral("corner, off-axis", off_axis, corner(), pixels);
}

TEST(VolumetricIntegral, BallOverPlane) {
  expect_integral("ball over a plane, perspective", perspective(440, 360), ball_over_plane(), beside_the_ball());
  expect_integral("ball over a plane, orthographic", orthographic(440, 360, 4), ball_over_plane(), beside_the_ball());
}

Frame with_layers(Frame frame, const std::vector<std::function<float(int x, int y)>>& layers) {
  for (size_t k = 0; k < layers.size(); ++k) {
    Channel& layer = plane_of(frame, layer_name("peel", int(k))).channels[0];
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) layer.at(x, y) = layers[k](x, y);
    }
  }
  normalise(frame);
  return frame;
}

float depth_at(const Shot& shot, const Scene& scene, int x, int y) {
  const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
  return seen ? float(seen->depth) : std::numeric_limits<float>::infinity();
}

TEST(VolumetricLayers, OneLayerThatIsTheDepth) {
  for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4)}) {
    const Frame frame = shoot(shot, room());
    const auto depth = [&](int x, int y) { return depth_at(shot, room(), x, y); };
    const auto nothing = [](int, int) { return std::numeric_limits<float>::infinity(); };
    const Frame one = with_layers(clone(frame), {depth}), three = with_layers(clone(frame), {nothing, depth, depth});
    for (const int lanes : {1, 16}) {
      for (const Math math : {Math::precise, Math::fast}) {
        for (const char* r : {"0.5", "3"}) {
          const RunOptions options{.math = math, .lanes = lanes};
          const Frame expected = raw_of("volumetric", frame, {{"radius", r}}, options);
          EXPECT_TRUE(same_bits(raw_of("dp-volumetric", one, {{"radius", r}}, options), expected))
              << lanes << ", " << r;
          EXPECT_TRUE(same_bits(raw_of("dp-volumetric", three, {{"radius", r}}, options), expected))
              << lanes << ", " << r;
        }
      }
    }
  }
}

/// A sign near the eye hides a block on the wall. It is too far before the wall to occlude it, so the depth alone shows
/// the wall beside the block open; without a limit the sign occludes. All layers show the block.
TEST(VolumetricLayers, AHiddenOccluder) {
  const Shot shot = perspective(160, 120);
  const Scene sign = within(tilted_plane(1, 0, 0), 0.1, 0.13), block = within(tilted_plane(3.6, 0, 0), 0.3, 0.4),
              wall = tilted_plane(4, 0, 0);
  const Frame frame = shoot(shot, nearest_of({sign, block, wall}));
  const auto layer = [&](size_t k) {
    return [&, k](int x, int y) {
      std::vector<float> depths;
      for (const Scene* scene : {&sign, &block, &wall}) depths.push_back(depth_at(shot, *scene, x, y));
      std::sort(depths.begin(), depths.end());
      return depths[k];
    };
  };
  const Frame peeled = with_layers(clone(frame), {layer(0), layer(1), layer(2)});
  const Frame without_sign = shoot(shot, nearest_of({block, wall}));
  // Right of the sign, 0.16 from the block's edge, at half its height.
  const int x = int(shot.camera.cx + 0.115 * shot.camera.fx), y = int(shot.camera.cy);
  for (const int lanes : {1, 16}) {
    const RunOptions options{.lanes = lanes};
    const Settings settings = {{"radius", "0.7"}, {"samples", "200"}};
    EXPECT_EQ(raw_at(raw_of("volumetric", frame, settings, options), x, y), 1);
    const float expected = raw_at(raw_of("volumetric", without_sign, settings, options), x, y);
    EXPECT_LT(expected, 0.97);
    EXPECT_NEAR(raw_at(raw_of("dp-volumetric", peeled, settings, options), x, y), expected, 1e-6) << lanes;
    Settings unlimited = settings;
    unlimited.push_back({"range", "inf"});
    EXPECT_LT(raw_at(raw_of("volumetric", frame, unlimited, options), x, y), 0.97) << "the sign takes nothing away";
  }
}

TEST(VolumetricIntegral, OtherSettings) {
  expect_integral("corner, no bias", perspective(440, 360), corner(), in_the_corner(), {.bias = 0});
  expect_integral("ball over a plane, short range", perspective(440, 360), ball_over_plane(), beside_the_ball(),
                  {.range = 0.6});
}

/// Where the eye looks along a plane, some of its columns reach over its horizon: what is seen there lies far behind.
TEST(VolumetricPlane, ReadsOpenAtTheHorizon) {
  const Scene hill = nearest_of({tilted_plane(3, 1.45, std::numbers::pi / 2), tilted_plane(40, 0, 0)});
  const Frame frame = shoot(perspective(160, 120), hill);
  const Frame out = raw_of("volumetric", frame, {{"radius", "0.3"}}, {});
  int on_plane = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (depth_at(perspective(160, 120), hill, x, y) > 30) continue;
      ++on_plane;
      EXPECT_NEAR(raw_at(out, x, y), 1, 1e-6) << x << ", " << y;
    }
  }
  EXPECT_GT(on_plane, 3000);
}

}  // namespace
}  // namespace gloam::test
