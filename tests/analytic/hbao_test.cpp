// HBAO against the expectation of its own sweep, over surfaces known in closed form; and what its parameters do.
//
// With ever more directions the estimate of any number of steps tends to
//   AO = 1 - mean over screen directions and over shifts s of sum over k of W(|v_k|) max(0, h(v_k) - highest h so far),
// v_k going from the point to what is seen at distance 1 + (s + k) (P - 1) / steps, h(v) = n.v/|v| (or its square), from
// the height of the bias on. The kernel differs from that by noise, which is measured, by float, and by looking at pixel
// centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float inf = std::numeric_limits<float>::infinity();

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

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

/// The expectation at the centre of a pixel, by midpoints.
double expectation(const Method& method, const Shot& shot, const Scene& scene, int x, int y) {
  constexpr int directions = 128;
  const int shifts = std::max(4, 128 / method.steps);
  const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
  const Surface here = scene(ray).value();
  const glm::dvec3 point = point_at(ray, here.depth);
  const double pixels = method.radius * shot.camera.fx / (shot.camera.orthographic ? 1 : here.depth);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * pi * (d + 0.5) / directions;
    for (int s = 0; s < shifts; ++s) {
      double highest = method.height(std::sin(method.bias));
      for (int k = 0; k < method.steps; ++k) {
        const double t = 1 + ((s + 0.5) / shifts + k) * (pixels - 1) / method.steps;
        const EyeRay other = ray_through(shot, x + 0.5 + t * std::cos(angle), y + 0.5 + t * std::sin(angle));
        const auto seen = scene(other);
        if (!seen) continue;
        const glm::dvec3 v = point_at(other, seen->depth) - point;
        const double height = method.height(std::max(0.0, glm::dot(here.normal, v) / glm::length(v)));
        const double weight = method.weight(glm::length(v));
        if (weight <= 0 || height <= highest) continue;
        sum += weight * (height - highest);
        highest = height;
      }
    }
  }
  return 1 - sum / (directions * shifts);
}

Plan plan_of(const std::string& technique, const Frame& frame, const Settings& settings,
             const std::vector<std::string>& only = {"ao_raw"}) {
  return make_plan({.outputs = {technique}, .only = only, .then = "none", .settings = settings}, plane_names(frame),
                   "this frame");
}

Frame raw_of(const std::string& technique, const Frame& frame, const RunOptions& options,
             const Settings& settings = {}) {
  return run(plan_of(technique, frame, settings), frame, device(), options).frame;
}

float raw_at(const Frame& result, int x, int y) { return result.views[0].find("ao_raw")->channels[0].at(x, y); }

void expect_expectation(const std::string& what, const Method& method, const Shot& shot, const Scene& scene,
                        const std::vector<glm::ivec2>& pixels) {
  constexpr int seeds = 10;
  const Frame frame = shoot(shot, scene);
  const Plan plan = plan_of("hbao", frame, method.settings());
  std::vector<double> sums(pixels.size()), squares(pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double value = raw_at(out, pixels[i].x, pixels[i].y);
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  double mean_off = 0, worst = 0, lowest = 1, noise = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const double mean = sums[i] / seeds, variance = std::max(0.0, squares[i] / seeds - mean * mean);
    const double error = std::sqrt(variance / (seeds - 1));
    const double expected = expectation(method, shot, scene, pixels[i].x, pixels[i].y);
    EXPECT_NEAR(mean, expected, 1e-3 + 4 * error) << what << " at " << pixels[i].x << ", " << pixels[i].y;
    mean_off += (mean - expected) / double(pixels.size());
    worst = std::max(worst, std::abs(mean - expected));
    noise += error * error / double(pixels.size());
    lowest = std::min(lowest, expected);
  }
  std::printf("hbao, %s, %s, %s, %d steps: AO down to %.3f; mean error %.2g, largest %.2g, of which noise %.2g\n",
              what.c_str(), method.falloff.c_str(), method.weighting.c_str(), method.steps, lowest, mean_off, worst,
              std::sqrt(noise));
  EXPECT_LT(lowest, 0.95) << what << ": the case tests nothing";
  EXPECT_LE(std::abs(mean_off), 1e-3) << what;
}

Scene nearer_of(const Scene& a, const Scene& b) {
  return [=](const EyeRay& ray) {
    const auto first = a(ray), second = b(ray);
    if (!first || !second) return first ? first : second;
    return first->depth < second->depth ? first : second;
  };
}

std::vector<Method> methods() {
  return {{.steps = 9},
          {.steps = 64},
          {.steps = 9, .falloff = "none"},
          {.steps = 9, .falloff = "linear"},
          {.steps = 9, .weighting = "cosine"},
          {.bias = 0.3, .steps = 32, .falloff = "none", .weighting = "cosine"}};
}

/// Two walls that meet in a line across the image, one of them steeper to the view than the other.
Scene corner() { return nearer_of(tilted_plane(4, pi / 4, pi / 2), tilted_plane(4, 1.0, -pi / 2)); }

TEST(HbaoExpectation, Corner) {
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 6; ++i) pixels.push_back({145 + 4 * i, 86 + 6 * i});
  for (const Method& method : methods()) {
    expect_expectation("corner, perspective", method, perspective(320, 256), corner(), pixels);
    expect_expectation("corner, orthographic", method, orthographic(320, 256, 4), corner(), pixels);
  }
}

TEST(HbaoExpectation, WavesOffTheCentre) {
  // Smooth all over: no outline between pixels, and horizons that rise in many small steps.
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
    if (method.bias > 0.2) continue;  // nothing here stands that high
    Method flat = method;
    flat.bias = 0.02;
    if (method.weighting == "cosine") flat.falloff = "none";  // else too little is left of low hills
    expect_expectation("waves, perspective", flat, perspective(320, 256), waves, pixels);
    expect_expectation("waves, orthographic", flat, orthographic(320, 256, 4), waves, pixels);
  }
}

/// The limit for many steps where the horizon is known: beside a step, on a surface that faces the eye, half of all
/// directions lead to its edge.
TEST(Hbao, ConvergesToTheHorizonWithoutFalloff) {
  const double rise = 0.3;
  const Scene step = [=](const EyeRay& ray) -> std::optional<Surface> {
    return Surface{ray.origin.x > 0 ? 4 - rise : 4.0, {0, 0, 1}};
  };
  const Shot shot = orthographic(480, 360, 4);
  const Frame frame = shoot(shot, step);
  const double pixel = 4.0 / 480, radius = 0.8;
  for (const bool cosine : {false, true}) {
    const Settings settings = {{"radius", "0.8"},    {"bias", "0"},
                               {"falloff", "none"},  {"weighting", cosine ? "cosine" : "uniform"},
                               {"directions", "64"}, {"steps", "128"}};
    const int x = 240 - 18, y = 180;
    double found = 0;
    for (int seed = 0; seed < 4; ++seed)
      found += raw_at(raw_of("hbao", frame, {.math = Math::precise, .seed = seed}, settings), x, y) / 4;
    // The edge lies half a pixel beyond the last one before it.
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
    // Pixels are 1/18 of the distance: where the stair of pixels stands in for a straight edge, second order remains.
    EXPECT_NEAR(found, 1 - taken, 4e-3);
  }
}

TEST(Hbao, AHigherBiasNeverDarkens) {
  const Frame frame = shoot(perspective(160, 120), room());
  Frame last = raw_of("hbao", frame, {}, {{"bias", "0"}});
  for (const char* bias : {"0.1", "0.5", "1.2"}) {
    Frame next = raw_of("hbao", frame, {}, {{"bias", bias}});
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

/// A layer's depth at a pixel whose visible depth is `depth`.
using Layer = std::function<float(int x, int y, float depth)>;

float same_depth(int, int, float depth) { return depth; }
float nothing(int, int, float) { return inf; }

Frame with_layers(const Frame& frame, const std::vector<Layer>& layers) {
  Frame copy = clone(frame);
  for (size_t k = 0; k < layers.size(); ++k) {
    Channel& layer = plane_of(copy, layer_name("peel", int(k))).channels[0];
    const Channel& depth = plane_of(copy, "depth").channels[0];
    for (int y = 0; y < copy.height(); ++y) {
      for (int x = 0; x < copy.width(); ++x) layer.at(x, y) = layers[k](x, y, depth.at(x, y));
    }
  }
  normalise(copy);
  return copy;
}

TEST(DpHbao, LayersThatSayWhatTheDepthSays) {
  const Layer even = [](int x, int y, float depth) { return (x + y) % 2 == 0 ? depth : inf; };
  const Layer odd = [](int x, int y, float depth) { return (x + y) % 2 != 0 ? depth : inf; };
  for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4)}) {
    const Frame frame = shoot(shot, room());
    for (const std::vector<Layer>& layers : std::vector<std::vector<Layer>>{
             {same_depth}, {same_depth, nothing}, {nothing, same_depth}, {same_depth, same_depth}, {odd, even}}) {
      const Frame layered = with_layers(frame, layers);
      for (const int lanes : usual_lanes(device())) {
        for (const Math math : {Math::precise, Math::fast}) {
          for (const char* weighting : {"uniform", "cosine"}) {
            const RunOptions options{.math = math, .lanes = lanes};
            const Settings settings = {{"weighting", weighting}, {"bias", "0.01"}};
            EXPECT_TRUE(
                same_bits(raw_of("dp-hbao", layered, options, settings), raw_of("hbao", frame, options, settings)))
                << layers.size() << " layers, lanes " << lanes << ", " << weighting;
          }
        }
      }
    }
  }
}

/// A sign near the eye hides a block on the wall: the depth alone shows the wall beside it open.
TEST(DpHbao, AHiddenOccluderDarkens) {
  const Shot shot = perspective(160, 120);
  const Scene sign = within(tilted_plane(1, 0, 0), 0.1, 0.13), block = within(tilted_plane(3.6, 0, 0), 0.3, 0.4),
              wall = tilted_plane(4, 0, 0);
  const auto layer_of = [&](const Scene& scene) {
    return [&](int x, int y, float) {
      const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
      return seen ? float(seen->depth) : inf;
    };
  };
  const Frame frame = with_layers(shoot(shot, nearer_of(sign, nearer_of(block, wall))),
                                  {layer_of(sign), layer_of(block), layer_of(wall)});
  // Right of the sign, 0.16 from the block's edge, at half its height.
  const int x = int(shot.camera.cx + 0.115 * shot.camera.fx), y = int(shot.camera.cy);
  const Settings settings = {{"radius", "0.8"}, {"directions", "8"}};
  for (const int lanes : usual_lanes(device())) {
    const RunOptions options{.lanes = lanes};
    EXPECT_EQ(raw_at(raw_of("hbao", frame, options, settings), x, y), 1);
    // Without the sign the depth shows the block.
    const float expected = raw_at(raw_of("hbao", shoot(shot, nearer_of(block, wall)), options, settings), x, y);
    EXPECT_LT(expected, 0.99);
    EXPECT_NEAR(raw_at(raw_of("dp-hbao", frame, options, settings), x, y), expected, 1e-6);
  }
}

/// An open plane's mean direction is its normal and its cone a hemisphere, at any tilt; beside a wall it leans away
/// from the wall as the mean of the open quarter does.
TEST(HbaoBentNormal, PlaneAndWall) {
  for (const double tilt : {0.0, 0.8, 1.4}) {
    const Frame frame = shoot(perspective(96, 72), tilted_plane(3, tilt, 0.4));
    const Frame out = run(plan_of("hbao", frame, {}, {"bent_normal", "cone"}), frame, device(), {}).frame;
    const Plane &bent = *out.views[0].find("bent_normal"), &normal = *frame.views[0].find("normal");
    double worst = 1, widest = 0;
    for (int y = 0; y < 72; ++y) {
      for (int x = 0; x < 96; ++x) {
        if (frame.views[0].find("depth")->channels[0].at(x, y) == inf) continue;
        double cosine = 0;
        for (size_t i = 0; i < 3; ++i) cosine += double(bent.channels[i].at(x, y)) * normal.channels[i].at(x, y);
        worst = std::min(worst, cosine);
        widest = std::max(widest, double(out.views[0].find("cone")->channels[0].at(x, y)));
      }
    }
    std::printf("hbao, bent normal of a plane tilted by %.1f: least cosine 1 - %.2g, cone %.2g\n", tilt, 1 - worst,
                widest);
    EXPECT_GT(worst, 1 - 1e-6);
    EXPECT_LT(widest, 1e-5);
  }
  // A wall so high and near (2 pixels) that it takes nearly half: the rest is a quarter of the sphere, with its mean at 45
  // degrees.
  const Scene step = [](const EyeRay& ray) -> std::optional<Surface> {
    return Surface{ray.origin.x > 0 ? 4 - 0.9 : 4.0, {0, 0, 1}};
  };
  const Frame frame = shoot(orthographic(480, 360, 4), step);
  const Frame out =
      run(plan_of("hbao", frame,
                  {{"radius", "8"}, {"max_reach", "1"}, {"falloff", "none"}, {"directions", "64"}, {"steps", "128"}},
                  {"bent_normal", "cone"}),
          frame, device(), {})
          .frame;
  const Plane& bent = *out.views[0].find("bent_normal");
  EXPECT_NEAR(bent.channels[0].at(238, 180), -std::sqrt(0.5), 0.03);
  EXPECT_NEAR(bent.channels[1].at(238, 180), 0, 0.03);
  EXPECT_NEAR(bent.channels[2].at(238, 180), std::sqrt(0.5), 0.03);
  // (1 + cosine) / 2 is the mean's length, 1 / sqrt(2).
  EXPECT_NEAR(out.views[0].find("cone")->channels[0].at(238, 180), std::sqrt(2.0) - 1, 0.03);
}

}  // namespace
}  // namespace gloam::test
