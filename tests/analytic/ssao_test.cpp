// SSAO against the integral that its points estimate, over surfaces known in closed form: the share of a half ball, a ball
// or a shell about the point whose places lie behind what the screen shows there. The kernel looks at pixel centres, which
// is an error of second order where a surface is smooth and of first order around outlines.
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
  bool hemisphere = true;
  double inner = 0, bias = 0.02, range = 2;
};

Settings settings_of(const Model& m) {
  return {{"radius", fmt::format("{}", radius)},       {"samples", "1024"},
          {"hemisphere", m.hemisphere ? "on" : "off"}, {"inner", fmt::format("{}", m.inner)},
          {"bias", fmt::format("{}", m.bias)},         {"range", fmt::format("{}", m.range)}};
}

/// 1 where a place, `offset` from the surface, lies behind what is seen on its way, less for what is far before.
double occlusion_at(const Shot& shot, const Scene& scene, const Surface& here, const glm::dvec3& point,
                    const glm::dvec3& offset, const Model& m) {
  const glm::dvec2 pixel = pixel_of(shot, point + offset);
  const EyeRay ray = ray_through(shot, pixel.x, pixel.y);
  const auto seen = scene(ray);
  if (!seen) return 0;
  // Lifted by the bias, along the ray.
  const double lift = m.hemisphere ? m.bias * glm::length(offset) : 0;
  const double depth = -(point + offset).z + lift / glm::dot(here.normal, ray.direction);
  const double before = (here.depth - seen->depth) / (m.range * radius);
  return seen->depth < depth ? std::clamp(2 - before, 0.0, 1.0) : 0;
}

double integral(const Shot& shot, const Scene& scene, int x, int y, const Model& m) {
  constexpr int points = 400000;
  const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
  const Surface here = scene(ray).value();
  const glm::dvec3 point = point_at(ray, here.depth);
  const double kept = 1 - m.inner * m.inner * m.inner;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 u = even(i);
    const double z = 2 * u.x - 1, level = std::sqrt(1 - z * z), turn = 2 * std::numbers::pi * u.y;
    glm::dvec3 offset =
        radius * std::cbrt(1 - kept * u.z) * glm::dvec3(level * std::cos(turn), level * std::sin(turn), z);
    if (m.hemisphere && glm::dot(offset, here.normal) < 0) offset = -offset;
    sum += occlusion_at(shot, scene, here, point, offset, m);
  }
  return 1 - sum / points;
}

/// The mean of the converged estimate over seeds against the integral, at each pixel.
void expect_integral(const char* what, const Shot& shot, const Scene& scene, const std::vector<glm::ivec2>& pixels,
                     const Model& model = {}) {
  const Frame frame = shoot(shot, scene);
  std::vector<double> sums(pixels.size()), squares(pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = raw_of("ssao", frame, settings_of(model), {.math = Math::precise, .seed = seed});
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
  std::printf("ssao, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g\n", what, lowest, mean, worst);
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

TEST(SsaoIntegral, Corner) {
  expect_integral("corner, perspective", perspective(440, 360), corner(), in_the_corner());
  expect_integral("corner, orthographic", orthographic(440, 360, 4), corner(), in_the_corner());
  Shot off_axis = perspective(440, 360);
  off_axis.camera.cx += 90;
  off_axis.camera.cy -= 30;
  std::vector<glm::ivec2> pixels = in_the_corner();
  for (glm::ivec2& p : pixels) p += glm::ivec2(90, -30);
  expect_integral("corner, off-axis", off_axis, corner(), pixels);
}

TEST(SsaoIntegral, BallOverPlane) {
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

TEST(SsaoLayers, OneLayerThatIsTheDepth) {
  for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4)}) {
    const Frame frame = shoot(shot, room());
    const auto depth = [&](int x, int y) { return depth_at(shot, room(), x, y); };
    const auto nothing = [](int, int) { return std::numeric_limits<float>::infinity(); };
    const Frame one = with_layers(clone(frame), {depth}), three = with_layers(clone(frame), {nothing, depth, depth});
    for (const int lanes : {1, 16}) {
      for (const Math math : {Math::precise, Math::fast}) {
        for (const char* r : {"0.5", "3"}) {
          const RunOptions options{.math = math, .lanes = lanes};
          const Frame expected = raw_of("ssao", frame, {{"radius", r}}, options);
          EXPECT_TRUE(same_bits(raw_of("dp-ssao", one, {{"radius", r}}, options), expected)) << lanes << ", " << r;
          EXPECT_TRUE(same_bits(raw_of("dp-ssao", three, {{"radius", r}}, options), expected)) << lanes << ", " << r;
        }
      }
    }
  }
}

/// A sign near the eye hides a block on the wall. It is too far before the wall to occlude it, so the depth alone shows
/// the wall beside the block open; without a limit the sign occludes. All layers show the block.
TEST(SsaoLayers, AHiddenOccluder) {
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
    EXPECT_EQ(raw_at(raw_of("ssao", frame, settings, options), x, y), 1);
    const float expected = raw_at(raw_of("ssao", without_sign, settings, options), x, y);
    EXPECT_LT(expected, 0.97);
    EXPECT_NEAR(raw_at(raw_of("dp-ssao", peeled, settings, options), x, y), expected, 1e-6) << lanes;
    Settings unlimited = settings;
    unlimited.push_back({"range", "inf"});
    EXPECT_LT(raw_at(raw_of("ssao", frame, unlimited, options), x, y), 0.97) << "the sign takes nothing away";
  }
}

TEST(SsaoIntegral, OtherSettings) {
  expect_integral("corner, shell", perspective(440, 360), corner(), in_the_corner(), {.inner = 0.8});
  expect_integral("ball over a plane, whole ball", perspective(440, 360), ball_over_plane(), beside_the_ball(),
                  {.hemisphere = false});
  expect_integral("ball over a plane, no bias, short range", perspective(440, 360), ball_over_plane(),
                  beside_the_ball(), {.bias = 0, .range = 0.6});
}

/// As in the paper: half of the ball lies behind a plane. The points of a pixel lie half above it, half below.
TEST(SsaoPlane, ReadsAHalfInTheWholeBall) {
  for (const double tilt : {0.0, 0.5, 0.95}) {
    const Frame frame = shoot(perspective(93, 61), tilted_plane(3, tilt, 0.4));
    const Frame out = raw_of("ssao", frame, {{"hemisphere", "off"}, {"range", "inf"}}, {});
    for (int y = 0; y < 61; ++y) {
      for (int x = 0; x < 93; ++x) {
        EXPECT_NEAR(raw_at(out, x, y), 0.5, 1e-6) << tilt << ": " << x << ", " << y;
      }
    }
  }
}

/// On a plane the mean open direction is the normal and the cone is the whole hemisphere; beside a wall the mean leans
/// away from it and the cone is narrower.
TEST(SsaoDirections, BentNormalAndCone) {
  const Shot shot = perspective(160, 120);
  const auto directions_of = [&](const Scene& scene) {
    const Frame frame = shoot(shot, scene);
    PlanRequest request{.outputs = {"ssao"}, .only = {"bent_normal", "cone"}, .then = "none"};
    request.settings = {{"samples", "512"}};
    return run(make_plan(request, plane_names(frame), "this frame"), frame, device(), {}).frame;
  };
  const auto bent_at = [](const Frame& f, int x, int y) {
    const auto& c = f.views[0].find("bent_normal")->channels;
    return glm::dvec3(c[0].at(x, y), c[1].at(x, y), c[2].at(x, y));
  };
  const auto cone_at = [](const Frame& f, int x, int y) { return f.views[0].find("cone")->channels[0].at(x, y); };
  const Frame flat = directions_of(tilted_plane(3, 0.7, 0.4));
  const glm::dvec3 normal = tilted_plane(3, 0.7, 0.4)(ray_through(shot, 1, 1))->normal;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      EXPECT_GT(glm::dot(bent_at(flat, x, y), normal), std::cos(0.01));
      EXPECT_NEAR(cone_at(flat, x, y), 0, 5e-3);
    }
  }
  const Frame folded = directions_of(corner());
  // Just above the line where the walls meet: the wall there faces down and to the eye, the bent normal leans to the eye.
  const glm::dvec3 wall = corner()(ray_through(shot, 80.5, 57.5))->normal, bent = bent_at(folded, 80, 57);
  EXPECT_GT(glm::dot(bent, glm::dvec3(0, 0, 1)), glm::dot(wall, glm::dvec3(0, 0, 1)) + 0.1);
  EXPECT_GT(cone_at(folded, 80, 57), 0.1);
}

}  // namespace
}  // namespace gloam::test
