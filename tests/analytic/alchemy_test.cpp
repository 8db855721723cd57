// Alchemy and Scalable Ambient Obscurance against the integral that their samples estimate, over surfaces known in closed
// form, and what their parameters do.
//
// With ever more samples the spiral tends to
//   AO = 1 - factor * strength * mean over screen directions and over distances t (pixels, uniform from 1 to the projected
//        radius P) of weight(v.v) max(0, v.n - bias) / (v.v + epsilon),
// v going from the point to what is seen at distance t, in radii; alchemy: factor 2, weight 1 below 1; sao: factor 5,
// weight (1 - v.v)^3. The kernel differs from that by noise, which is measured, by float, and by looking at pixel centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double radius = 0.8;
constexpr int seeds = 12;

/// What both have in common; `bias` in depths.
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

Plan plan_of(const std::string& technique, const Settings& settings, const std::vector<std::string>& available) {
  return make_plan({.outputs = {technique}, .then = "none", .settings = settings}, available, "this frame");
}

Frame raw_of(const std::string& technique, const Frame& frame, const Settings& settings,
             const RunOptions& options = {.math = Math::precise}) {
  return run(plan_of(technique, settings, plane_names(frame)), frame, device(), options).frame;
}

float raw_at(const Frame& result, int x, int y) { return result.views[0].find("ao_raw")->channels[0].at(x, y); }

glm::dvec3 point_at(const EyeRay& ray, double depth) { return ray.origin + depth * ray.direction; }

double contribution(const std::string& technique, const Values& values, double height, double square, double bias) {
  if (square >= 1) return 0;
  const double over = std::max(0.0, height - bias) / (square + values.epsilon);
  return values.strength * over * (technique == "sao" ? 5 * std::pow(1 - square, 3) : 2);
}

/// The integral at the centre of a pixel, by midpoints.
double integral(const std::string& technique, const Values& values, const Shot& shot, const Scene& scene, int x,
                int y) {
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
      const glm::dvec3 v = (point_at(other, seen->depth) - point) / radius;
      sum +=
          contribution(technique, values, glm::dot(v, here.normal), glm::dot(v, v), values.bias * here.depth / radius);
    }
  }
  return std::clamp(1 - sum / (directions * steps), 0.0, 1.0);
}

/// Mean and standard error of that mean at one pixel, over seeds.
struct Estimate {
  double mean = 0, error = 0;
};

std::vector<Estimate> estimates(const std::string& technique, const Values& values, const Shot& shot,
                                const Scene& scene, const std::vector<glm::ivec2>& pixels) {
  const Frame frame = shoot(shot, scene);
  Settings settings = settings_of(values);
  for (const auto& setting : find_technique(technique).converged) settings.push_back(setting);
  const Plan plan = plan_of(technique, settings, plane_names(frame));
  std::vector<double> sums(pixels.size()), squares(pixels.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame out = run(plan, frame, device(), {.math = Math::precise, .seed = seed}).frame;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double value = raw_at(out, pixels[i].x, pixels[i].y);
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

/// What the estimate is off by, systematically (mean over pixels) and at one pixel: `bound` beside the noise.
void expect_integral(const char* what, double bound, const Shot& shot, const Scene& scene,
                     const std::vector<glm::ivec2>& pixels) {
  for (const std::string technique : {"alchemy", "sao"}) {
    const Values values;
    const std::vector<Estimate> found = estimates(technique, values, shot, scene, pixels);
    double off_sum = 0, worst = 0, noise = 0, lowest = 1;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const double expected = integral(technique, values, shot, scene, pixels[i].x, pixels[i].y);
      const double off = found[i].mean - expected;
      off_sum += off;
      noise += found[i].error * found[i].error;
      worst = std::max(worst, std::abs(off));
      lowest = std::min(lowest, expected);
      EXPECT_GT(expected, 0.05) << technique << ", " << what << ": clamped, so nothing is compared";
      EXPECT_NEAR(found[i].mean, expected, bound + 4 * found[i].error)
          << technique << ", " << what << " at " << pixels[i].x << ", " << pixels[i].y;
    }
    const double count = double(pixels.size()), mean = off_sum / count;
    std::printf("%s, %s: AO down to %.3f; mean error %.2g, largest at one pixel %.2g, of which noise %.2g\n",
                technique.c_str(), what, lowest, mean, worst, std::sqrt(noise / count));
    EXPECT_LT(lowest, 0.97) << technique << ", " << what << ": the case tests nothing";
    EXPECT_LE(std::abs(mean), 1e-3) << technique << ", " << what;
  }
}

/// What is nearer of two scenes.
Scene nearer_of(const Scene& a, const Scene& b) {
  return [=](const EyeRay& ray) {
    const auto first = a(ray), second = b(ray);
    if (!first || !second) return first ? first : second;
    return first->depth < second->depth ? first : second;
  };
}

Scene ball(const glm::dvec3& centre, double size) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.direction, ray.origin - centre);
    const double c = glm::dot(ray.origin - centre, ray.origin - centre) - size * size, root = b * b - a * c;
    if (root < 0) return {};
    const double depth = (-b - std::sqrt(root)) / a;
    return Surface{depth, glm::normalize(point_at(ray, depth) - centre)};
  };
}

TEST(AlchemyIntegral, RightAngledCorner) {
  // Two walls at 45 degrees to the view axis that meet in a line across the image.
  const double quarter = std::numbers::pi / 4;
  const Scene corner =
      nearer_of(tilted_plane(4, quarter, std::numbers::pi / 2), tilted_plane(4, quarter, -std::numbers::pi / 2));
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({200 + 3 * i, 168 - 3 * i});
  expect_integral("corner, perspective", 1e-3, perspective(440, 360, 30), corner, pixels);
  expect_integral("corner, orthographic", 1e-3, orthographic(440, 360, 2.2), corner, pixels);
}

TEST(AlchemyIntegral, BallOverTiltedPlane) {
  // Pixels on an outline are wholly on it or wholly off: 0.0021 of 0.05 at the worst pixel measured, a few pixels from the
  // ball with a radius of 160 pixels, and of either sign, so that the mean stays within 3e-4.
  constexpr double outline = 2e-3;
  const Scene scene = nearer_of(ball({0, 0, -3.9}, 0.4), tilted_plane(4, 0.4, 0.3));
  std::vector<glm::ivec2> pixels;
  for (int i = 0; i < 14; ++i) pixels.push_back({220 + 92 + 2 * i, 172 + i});
  expect_integral("ball over a tilted plane, perspective", outline, perspective(440, 360, 30), scene, pixels);
  expect_integral("ball over a tilted plane, orthographic", outline, orthographic(440, 360, 2.2), scene, pixels);
}

TEST(AlchemyIntegral, Plane) {
  for (const std::string technique : {"alchemy", "sao"}) {
    for (const double tilt : {0.0, 0.7, 1.3, 1.5}) {
      const Frame frame = shoot(perspective(160, 120), tilted_plane(3, tilt, 0.4));
      for (const double bias : {1e-4, 0.0}) {
        const Frame out = raw_of(technique, frame, settings_of({.strength = 1, .bias = bias}));
        double worst = 0;
        for (int y = 0; y < 120; ++y) {
          for (int x = 0; x < 160; ++x) worst = std::max(worst, std::abs(1.0 - raw_at(out, x, y)));
        }
        std::printf("%s, plane tilted by %.1f, bias %g: largest distance from open %.2g\n", technique.c_str(), tilt,
                    bias, worst);
        // Without a bias nothing is left to swallow the rounding of depths: 6e-8 of 3.75 radii, times 5 / (v.v + 0.01)
        // for the worst sample, and half of that for what is above the plane.
        EXPECT_LE(worst, bias > 0 ? 0 : 5e-5);
      }
    }
  }
}

// --- Parameters

/// A plate parallel to the screen, `height` above a wall at depth 4; the receiver is beside it.
Scene plate_over_wall(double height) {
  return nearer_of(within(tilted_plane(4 - height, 0, 0), 0.2, 0.2), tilted_plane(4, 0, 0));
}

constexpr glm::ivec2 beside_plate(94, 60);

double occlusion(const std::string& technique, double height, const Values& values, const Settings& more = {}) {
  Settings settings = settings_of(values);
  settings.insert(settings.end(), more.begin(), more.end());
  settings.emplace_back("samples", "400");
  const Frame out = raw_of(technique, shoot(perspective(160, 120), plate_over_wall(height)), settings);
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

/// Alchemy counts all within the radius, and nothing beyond; sao fades.
TEST(AlchemyParameters, TheRadiusIsALimit) {
  const Values values{.strength = 0.2, .bias = 0, .epsilon = 0.01};
  for (const std::string technique : {"alchemy", "sao"}) EXPECT_EQ(occlusion(technique, 0.81, values), 0) << technique;
  EXPECT_GT(occlusion("alchemy", 0.6, values), 0.01);
  EXPECT_GT(occlusion("sao", 0.6, values), 0);
  // In relation to alchemy: 5/2 (1 - v.v)^3, v.v being 0.56 and more of the squared radius.
  EXPECT_LT(occlusion("sao", 0.6, values), 2.5 * std::pow(1 - 0.56, 3) * occlusion("alchemy", 0.6, values));
}

// --- Over depth layers

Frame with_layers(const Frame& frame, const std::vector<const Frame*>& layers) {
  Frame copy = clone(frame);
  for (size_t k = 0; k < layers.size(); ++k) {
    Channel& layer = plane_of(copy, layer_name("peel", int(k))).channels[0];
    const Channel& depth = layers[k]->views[0].find("depth")->channels[0];
    for (int y = 0; y < copy.height(); ++y) {
      for (int x = 0; x < copy.width(); ++x) layer.at(x, y) = depth.at(x, y);
    }
  }
  normalise(copy);
  return copy;
}

std::vector<RunOptions> all_widths() {
  std::vector<RunOptions> all;
  for (const int lanes : usual_lanes(device())) {
    for (const Math math : {Math::precise, Math::fast}) all.push_back({.math = math, .lanes = lanes});
  }
  return all;
}

TEST(DpAlchemy, OneLayerThatIsTheDepthGivesTheSameBits) {
  for (const std::string technique : {"alchemy", "sao"}) {
    for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4)}) {
      const Frame frame = shoot(shot, room());
      const Frame one = with_layers(frame, {&frame});
      for (const char* size : {"0.5", "3"}) {
        for (const RunOptions& options : all_widths()) {
          EXPECT_TRUE(same_bits(raw_of("dp-" + technique, one, {{"radius", size}}, options),
                                raw_of(technique, frame, {{"radius", size}}, options)))
              << technique << ", radius " << size << ", lanes " << options.lanes;
        }
      }
    }
  }
}

/// A sign near the eye hides a block on the wall: the depth alone shows the wall beside it open.
TEST(DpAlchemy, AHiddenOccluderCounts) {
  const Shot shot = perspective(160, 120);
  const Scene sign = within(tilted_plane(1, 0, 0), 0.1, 0.13), block = within(tilted_plane(3.6, 0, 0), 0.3, 0.4),
              wall = tilted_plane(4, 0, 0);
  const Frame first = shoot(shot, sign), second = shoot(shot, block), last = shoot(shot, wall);
  const Frame frame = with_layers(shoot(shot, nearer_of(sign, wall)), {&first, &second, &last});
  const int x = int(shot.camera.cx + 0.115 * shot.camera.fx), y = int(shot.camera.cy);
  for (const std::string technique : {"alchemy", "sao"}) {
    for (const RunOptions& options : all_widths()) {
      const Settings settings = {{"radius", "0.8"}, {"strength", "0.5"}};
      EXPECT_EQ(raw_at(raw_of(technique, frame, settings, options), x, y), 1) << technique;
      EXPECT_LT(raw_at(raw_of("dp-" + technique, frame, settings, options), x, y), 0.95) << technique;
    }
  }
}

}  // namespace
}  // namespace gloam::test
