// Ambient occlusion through any projection: with a camera's map, the same as the techniques for that camera; with two slits, a
// closed form, on flat and convex screens, for turned modules and sheared worlds.
#include "support/light_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "gloam/error.h"
#include "gloam/projection.h"
#include "gloam/scene/capture.h"
#include "plan/key_views.h"
#include "run/kernel_projection.h"
#include "support/integral.h"
#include "support/long.h"
#include "support/stress.h"

namespace gloam::test::light_field_test {
namespace {

using glm::dvec2;
using glm::dvec3;

// --- With a camera's map

Shot off_axis() {
  Shot shot = perspective(160, 120, 80);
  shot.camera.cx -= 30;
  shot.camera.cy += 20;
  return shot;
}

/// Share of pixels that differ by more than rounding. Another order of multiplications may move a sample to the neighbouring
/// pixel, where it counts differently.
double share_that_differs(const Frame& a, const Frame& b) {
  int differ = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) differ += std::abs(raw_at(a, x, y) - raw_at(b, x, y)) > 1e-5;
  }
  return double(differ) / (a.width() * a.height());
}

void expect_the_same(const std::string& technique, const Settings& own, const std::string& plain,
                     const Settings& settings) {
  for (const Shot& shot : {perspective(160, 120), off_axis(), orthographic(160, 120, 4)}) {
    const Frame frame = shoot(shot, room());
    for (const Math math : {Math::precise, Math::fast}) {
      const Frame expected = raw_of(plain, frame, settings, {.math = math, .seed = 3});
      const Frame found = raw_of(technique, frame, joined(settings, own), {.math = math, .seed = 3});
      EXPECT_GT(largest_occlusion(expected), 0.25);
      EXPECT_LE(share_that_differs(found, expected), 1e-3) << technique;
    }
  }
}

TEST(LightFieldCamera, SsaoInTheWholeBall) {
  for (const char* outside : {"border", "open"})
    expect_the_same("lightfield-ssao", {{"radii", "1"}}, "ssao",
                    {{"samples", "64"}, {"hemisphere", "off"}, {"range", "inf"}, {"outside", outside}});
}

TEST(LightFieldCamera, SsaoInTheHalfBall) {
  expect_the_same("lightfield-ssao", {{"radii", "1"}}, "ssao", {{"samples", "64"}, {"range", "1.5"}});
  expect_the_same("lightfield-ssao", {{"radii", "1"}}, "ssao",
                  {{"samples", "16"}, {"range", "inf"}, {"bias", "0"}, {"inner", "0.8"}, {"radius", "1.2"}});
}

TEST(LightFieldCamera, HbaoPlus) {
  expect_the_same("lightfield-hbao+", {}, "hbao+", {});
  expect_the_same("lightfield-hbao+", {}, "hbao+",
                  {{"directions", "5"}, {"steps", "7"}, {"falloff", "none"}, {"bias", "0"}, {"strength", "0.7"}});
  expect_the_same("lightfield-hbao+", {}, "hbao+", {{"radius", "1.5"}, {"outside", "open"}});
}

// --- The map itself

/// The largest distance of a frame's captured positions, mapped to the image, from their pixels' centres. Positions within a
/// hundredth of the way between the slits from one of them are left out: a float's last digit there is an ever larger part of a
/// pixel.
double largest_slip(const Frame& frame, const Frame& positions) {
  double worst = 0, worst_depth = 0;
  for (size_t i = 0; i < frame.views.size(); ++i) {
    const View& view = frame.views[i];
    const std::vector<Channel>& p = positions.views[i].planes.at("position").channels;
    const Pose& pose = *view.camera->pose;
    const double slit = depth_of_slit(*view.camera);
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double depth = view.planes.at("depth").channels[0].at(x, y);
        if (!(depth > 0.01 * slit && depth < 0.99 * slit)) continue;
        const dvec3 world = positions.views[i].origin + dvec3(p[0].at(x, y), p[1].at(x, y), p[2].at(x, y));
        const auto place = pixel_of(*view.camera, pose.world_to_view * (world - pose.position));
        const double slip = place ? glm::length(*place - dvec2(x + 0.5, y + 0.5)) : 1e9;
        if (slip > worst) worst = slip, worst_depth = depth / slit;
      }
    }
  }
  std::printf("largest slip %.5f pixels, at %.4f of the way between the slits\n", worst, worst_depth);
  return worst;
}

double surfaces_share(const View& view) {
  const Channel& depth = view.planes.at("depth").channels[0];
  double count = 0;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x) count += !is_background(depth.at(x, y));
  return count / (depth.layout().width * depth.layout().height);
}

Frame positions_of(const Frame& frame, const RunOptions& options = {}) {
  return run(make_plan({.outputs = {"positions"}}, {"depth"}, "this frame"), frame, device(), options).frame;
}

TEST(LightFieldMap, PositionsProjectToTheirPixels) {
  for (const auto& [name, display] : display_cases()) {
    SCOPED_TRACE(name);
    const Frame frame = captured(display, 320, 256);
    EXPECT_GT(surfaces_share(frame.views[0]), 0.5);
    EXPECT_LT(largest_slip(frame, frame), 0.01) << "captured";
    EXPECT_LT(largest_slip(frame, positions_of(frame)), 0.01) << "from depth, in float";
    EXPECT_LT(largest_slip(frame, positions_of(frame, {.math = Math::precise, .lanes = 1})), 0.01);
  }
}

/// The centre of an almost flat screen's cylinder lies a thousand screens behind it.
TEST(LightFieldMap, AnAlmostFlatScreenKeepsItsDigits) {
  LightFieldDisplay display = flat_display();
  display.screen_radius = 3000;
  const Frame frame = captured(display, 160, 128);
  EXPECT_LT(largest_slip(frame, positions_of(frame)), 0.01);
}

// --- AO through two slits

/// A scene with its axis through the middle of a shot's image at the depth of the screen.
test::Scene centred(const Shot& shot, const test::Scene& scene) {
  const EyeRay middle = ray_through(shot, 0.5 * shot.width, 0.5 * shot.height);
  const double depth = depth_of_screen(shot.camera);
  const dvec3 aside = point_at(middle, depth) + dvec3(0, 0, depth);
  return [=](const EyeRay& ray) { return scene({ray.origin - aside, ray.direction}); };
}

TEST(LightFieldPlane, IsOpenAtEveryTilt) {
  for (const auto& [name, display] : display_cases()) {
    const Shot shot = shot_of_module(display, 120, 90);
    for (const double tilt : {0.0, 0.5, 1.0}) {
      for (const double turn : {0.3, 2.0, 3.9}) {
        SCOPED_TRACE(fmt::format("{}: tilted by {} towards {}", name, tilt, turn));
        const Frame frame = shoot(shot, centred(shot, tilted_plane(depth_of_screen(shot.camera), tilt, turn)));
        EXPECT_GT(surfaces_share(frame.views[0]), 0.4);
        for (const std::string technique : {"lightfield-ssao", "lightfield-hbao+"}) {
          const Frame found = raw_of(technique, frame);
          EXPECT_EQ(largest_occlusion(found), 0) << technique;
        }
      }
    }
  }
}

/// Half of the whole ball around a point of a plane lies behind the plane: of an even number of points of the spiral, exactly half. Only
/// where positions are read, in a float's steps, a point beside the plane, seldom two of the eight, may come to lie on its other side.
TEST(LightFieldPlane, ClosesHalfOfTheWholeBall) {
  for (const auto& [name, display] : display_cases()) {
    const Shot shot = shot_of_module(display, 120, 90);
    for (const double tilt : {0.0, 0.5, 1.0}) {
      for (const char* inner : {"0", "0.8"}) {
        const Frame frame = shoot(shot, centred(shot, tilted_plane(depth_of_screen(shot.camera), tilt, 2)));
        const Frame found = raw_of("lightfield-ssao", frame,
                                   {{"hemisphere", "off"}, {"range", "inf"}, {"inner", inner}, {"radii", "3"}});
        const Channel& depth = frame.views[0].planes.at("depth").channels[0];
        double surfaces = 0, other = 0;
        for (int y = 10; y < 80; ++y) {
          for (int x = 10; x < 110; ++x) {
            if (is_background(depth.at(x, y))) continue;
            ++surfaces;
            other += raw_at(found, x, y) != 0.5f;
            EXPECT_NEAR(raw_at(found, x, y), 0.5, 0.25);
          }
        }
        EXPECT_GT(surfaces, 2000);
        EXPECT_LE(other, 0.01 * surfaces) << name << ", tilt " << tilt << ", inner " << inner;
      }
    }
  }
}

/// Two walls that meet at a right angle, in a line through the middle of the image; radians.
struct RightAngle {
  dvec3 normals[2], point;
  test::Scene scene;
};

RightAngle right_angle(const Shot& shot, double roll) {
  RightAngle walls;
  const double s = std::numbers::sqrt2 / 2, depth = depth_of_screen(shot.camera);
  walls.point = point_at(ray_through(shot, 0.5 * shot.width, 0.5 * shot.height), depth);
  walls.normals[0] = {s * std::cos(roll), s * std::sin(roll), s};
  walls.normals[1] = {-s * std::cos(roll), -s * std::sin(roll), s};
  walls.scene = centred(shot, nearest_of({tilted_plane(depth, std::numbers::pi / 4, roll),
                                          tilted_plane(depth, std::numbers::pi / 4, roll + std::numbers::pi)}));
  return walls;
}

/// Share of a half ball of radius 1 above one wall that lies behind the other wall, `height` away, between the spheres of radius
/// `inner` and 1.
double share_behind(double height, double inner) {
  const auto cap = [height](double r) { return height < r ? (r - height) * (r - height) * (2 * r + height) : 0; };
  return (cap(1) - cap(inner)) / (4 * (1 - inner * inner * inner));
}

/// Mean over seeds.
std::vector<double> mean_of_seeds(const std::string& technique, const Frame& frame, const Settings& settings,
                                  int seeds) {
  std::vector<double> mean(size_t(frame.width()) * size_t(frame.height()), 0);
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame found = raw_of(technique, frame, settings, {.seed = seed});
    for (int y = 0; y < frame.height(); ++y)
      for (int x = 0; x < frame.width(); ++x)
        mean[size_t(y) * size_t(frame.width()) + size_t(x)] += raw_at(found, x, y) / seeds;
  }
  return mean;
}

struct Errors {
  double bias = 0, rmse = 0;
  int pixels = 0;
};

/// Expected AO of the pixels' points compared with the results, where the ball's image lies inside the image.
/// `whole`: of the whole ball, whose lower half lies behind the point's own wall.
Errors errors_in_corner(const Shot& shot, const RightAngle& walls, double radius, double inner, bool whole,
                        const Settings& settings) {
  const Frame frame = shoot(shot, walls.scene);
  const std::vector<double> found = mean_of_seeds("lightfield-ssao", frame, settings, 2);
  Errors e;
  for (int y = shot.height / 4; y < shot.height * 3 / 4; ++y) {
    for (int x = shot.width / 4; x < shot.width * 3 / 4; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const auto seen = walls.scene(ray);
      if (!seen) continue;
      const dvec3 point = point_at(ray, seen->depth);
      const int other = glm::dot(seen->normal, walls.normals[0]) > 0.9 ? 1 : 0;
      const double height = glm::dot(walls.normals[other], point - walls.point) / radius;
      if (height > 0.95) continue;
      const double open = (1 - share_behind(height, inner)) * (whole ? 0.5 : 1);
      const double off = found[size_t(y) * size_t(shot.width) + size_t(x)] - open;
      e.bias += off;
      e.rmse += off * off;
      ++e.pixels;
    }
  }
  e.bias /= e.pixels;
  e.rmse = std::sqrt(e.rmse / e.pixels);
  return e;
}

/// For every projection, a certain share of the half ball of a point beside a wall lies behind the wall. The walls do not hide
/// each other, so no direction is special. Without a bias, which lifts points along rays.
TEST(LightFieldCorner, ReadsTheShareOfTheBallBehindTheOtherWall) {
  const double radius = 0.5;
  for (const auto& [name, display] : display_cases()) {
    const Shot shot = shot_of_module(display, 240, 180);
    for (const double roll : {0.0, 0.8, std::numbers::pi / 2}) {
      for (const double inner : roll == 0.8 ? std::vector<double>{0, 0.8} : std::vector<double>{0}) {
        for (const bool whole : {false, true}) {
          const RightAngle walls = right_angle(shot, roll);
          const Errors e = errors_in_corner(shot, walls, radius, inner, whole,
                                            {{"samples", "256"},
                                             {"radii", "1"},
                                             {"radius", "0.5"},
                                             {"range", "inf"},
                                             {"bias", "0"},
                                             {"hemisphere", whole ? "off" : "on"},
                                             {"inner", fmt::format("{}", inner)}});
          std::printf("%s, roll %.2f, inner %.1f, %s: bias %.4f, rmse %.4f, %d pixels\n", name.c_str(), roll, inner,
                      whole ? "whole ball" : "half ball", e.bias, e.rmse, e.pixels);
          EXPECT_GT(e.pixels, 1000);
          EXPECT_LT(std::abs(e.bias), 0.004) << name << ", roll " << roll;
          EXPECT_LT(e.rmse, 0.015) << name << ", roll " << roll;
        }
      }
    }
  }
}

/// Length of 1 scene unit in the image at a point, pixels along each axis.
dvec2 pixels_per_length(const Shot& shot, const dvec3& point) {
  const double step = 1e-4;
  const dvec2 here = pixel_of(shot, point);
  return {std::abs(pixel_of(shot, point + dvec3(step, 0, 0)).x - here.x) / step,
          std::abs(pixel_of(shot, point + dvec3(0, step, 0)).y - here.y) / step};
}

/// 1 - 2 * mean obscurance over an ellipse in the image, the image of a disc of the radius.
double obscurance_integral(const IntegralCase& test, glm::ivec2 pixel, double radius, double bias) {
  constexpr int directions = 96, distances = 96;
  const Receiver here = receiver_at(test, pixel);
  const dvec2 reach = radius * pixels_per_length(test.shot, here.point) - 1.0;
  const Contribution contribution = obscurance(radius, bias);
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * std::numbers::pi * (d + 0.5) / directions;
    for (int k = 0; k < distances; ++k) {
      const dvec2 far = 1.0 + reach * ((k + 0.5) / distances);
      const auto v = towards(test, here, dvec2(pixel) + 0.5 + far * dvec2(std::cos(angle), std::sin(angle)));
      if (v) sum += contribution(*v, here.surface);
    }
  }
  return 1 - 2 * sum / (directions * distances);
}

TEST(LightFieldCorner, HbaoPlusReadsItsIntegral) {
  ONLY_IN_LONG_RUN();
  for (const auto& [name, display] : display_cases()) {
    const Shot shot = shot_of_module(display, 300, 240);
    for (const double roll : {0.4, 1.5}) {
      IntegralCase test{fmt::format("{}, roll {}", name, roll), shot, {}, {}};
      test.scene = right_angle(shot, roll).scene;
      for (int i = 0; i < 8; ++i) test.pixels.push_back({115 + 9 * i, 105 + 4 * i});
      expect_integral(
          test, "lightfield-hbao+", {{"radius", "0.6"}, {"directions", "32"}, {"steps", "32"}},
          [](const IntegralCase& c, glm::ivec2 pixel) { return obscurance_integral(c, pixel, 0.6, 0.1); },
          {.pixel = 4e-3, .mean = 2e-3}, 4);
    }
  }
}

// --- Points and radii

double mean_difference(const Frame& a, const Frame& b) {
  return difference(*a.views[0].find("ao_raw"), *b.views[0].find("ao_raw")).mean;
}

Shot room_shot() {
  LightFieldDisplay display = flat_display();
  display.world->linear = glm::dmat3(2, 0, 0, 0, 2, 0, 0, 0, 1.6);
  return shot_of_module(display, 160, 120);
}

TEST(LightFieldPoints, AllSetsTendToTheSame) {
  const Frame frame = shoot(room_shot(), room());
  for (const char* inner : {"0", "0.8"}) {
    const auto with = [&](const char* points) {
      return raw_of("lightfield-ssao", frame,
                    {{"samples", "256"}, {"radii", "2"}, {"points", points}, {"inner", inner}});
    };
    const Frame spiral = with("spiral");
    EXPECT_GT(largest_occlusion(spiral), 0.4);
    for (const char* points : {"random", "jittered", "latin_square", "poisson_disk"}) {
      const double off = mean_difference(with(points), spiral);
      std::printf("%s, inner %s: mean difference %.4f\n", points, inner, off);
      EXPECT_GT(off, 0) << points << " are other points";
      EXPECT_LT(off, 0.02) << points;
    }
  }
}

/// How many of the pixels of a plane have 0, 1, ... of 8 points in the lower half of the ball, which the plane hides.
std::vector<double> pixels_by_hidden_points(const char* points, int seed, const char* jitter = "on") {
  const Frame frame = shoot(perspective(160, 120), tilted_plane(4, 0, 0));
  const Frame found = raw_of("lightfield-ssao", frame,
                             {{"samples", "8"},
                              {"radii", "1"},
                              {"hemisphere", "off"},
                              {"range", "inf"},
                              {"points", points},
                              {"jitter", jitter}},
                             {.seed = seed});
  std::vector<double> pixels(9, 0);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) ++pixels.at(size_t(std::lround(8 * (1 - raw_at(found, x, y)))));
  }
  return pixels;
}

/// Each pixel has points of its own. Of 8 independent ones the number in one half of the ball is binomial: 99.9 % of the figures stay
/// below 26.1 (8 degrees of freedom).
TEST(LightFieldPoints, RandomOnesAreIndependentInEveryPixel) {
  for (const int seed : {0, 1, 77}) {
    const std::vector<double> pixels = pixels_by_hidden_points("random", seed);
    double chi = 0, ways = 1;
    for (int k = 0; k <= 8; ways *= (8 - k) / (k + 1.0), ++k) {
      const double expected = 160 * 120 * ways / 256;
      chi += (pixels[size_t(k)] - expected) * (pixels[size_t(k)] - expected) / expected;
    }
    std::printf("seed %d: chi-square %.1f\n", seed, chi);
    EXPECT_LT(chi, 26.1) << "seed " << seed;
  }
}

/// The mean over pixels is that of the volume for every set, whatever the one in the table is like. Where the points are spread evenly
/// in height, as all but the random ones are, 3 to 5 of 8 lie in either half.
TEST(LightFieldPoints, OtherSetsDifferFromPixelToPixelToo) {
  for (const char* points : {"random", "jittered", "latin_square", "poisson_disk"}) {
    const std::vector<double> pixels = pixels_by_hidden_points(points, 3);
    double mean = 0;
    int kinds = 0;
    for (size_t k = 0; k <= 8; ++k) mean += double(k) * pixels[k] / (160 * 120), kinds += pixels[k] > 0;
    EXPECT_NEAR(mean, 4, 0.05) << points;
    EXPECT_GT(kinds, 1) << points;
    EXPECT_NE(pixels, pixels_by_hidden_points(points, 4)) << points << ": a seed chooses other points";
  }
  for (const char* points : {"random", "latin_square"}) {
    const std::vector<double> pixels = pixels_by_hidden_points(points, 3, "off");
    EXPECT_EQ(*std::max_element(pixels.begin(), pixels.end()), 160 * 120) << points << " without jitter: all alike";
  }
}

/// Of several radii the one that takes most counts.
TEST(LightFieldPoints, EachRadiusIsARunOfItsOwn) {
  const Frame frame = shoot(room_shot(), room());
  const auto with = [&](const char* radius, const char* radii) {
    return raw_of("lightfield-ssao", frame,
                  {{"samples", "256"}, {"radius", radius}, {"radii", radii}, {"ratio", "0.4"}});
  };
  const Frame all = with("0.8", "3"), large = with("0.8", "1"), middle = with("0.32", "1"), small = with("0.128", "1");
  double off = 0, smaller_counts = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double least = std::min({raw_at(large, x, y), raw_at(middle, x, y), raw_at(small, x, y)});
      off += std::abs(raw_at(all, x, y) - least) / (160 * 120);
      smaller_counts += raw_at(large, x, y) > least + 0.05;
    }
  }
  std::printf("radii: mean difference %.4f, smaller ones count on %.0f pixels\n", off, smaller_counts);
  EXPECT_GT(smaller_counts, 200) << "else the first radius alone would do";
  EXPECT_LT(off, 0.01);
}

// --- Reuse

LightFieldDisplay row_of(int count) {
  LightFieldDisplay display = flat_display();
  display.world.reset();
  display.modules.clear();
  for (int i = 0; i < count; ++i) display.modules.push_back({{0.15 * (i - 0.5 * (count - 1)), 0, -5}});
  return display;
}

double rmse(const View& a, const View& b) {
  const Channel &of_a = a.planes.at("ao_raw").channels[0], &of_b = b.planes.at("ao_raw").channels[0];
  double sum = 0;
  for (int y = 0; y < of_a.layout().height; ++y)
    for (int x = 0; x < of_a.layout().width; ++x) sum += std::pow(of_a.at(x, y) - of_b.at(x, y), 2);
  return std::sqrt(sum / (of_a.layout().width * of_a.layout().height));
}

bool same_ao(const View& a, const View& b) { return difference(a.planes.at("ao_raw"), b.planes.at("ao_raw")).max == 0; }

const std::vector<std::string> both_techniques = {"lightfield-ssao", "lightfield-hbao+"};

/// A module that occurs twice: its second view shows the points of the first, and reuses all of them. It has other normals, so
/// that a computed pixel would differ.
TEST(LightFieldReuse, FindsEveryPixelOfTheSameModule) {
  for (auto& [name, display] : display_cases()) {
    display.modules.push_back(display.modules[0]);
    Frame frame = captured(display, 160, 128);
    for (Channel& channel : frame.views[0].planes.at("normal").channels)
      for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 160; ++x) channel.at(x, y) = channel.at(x, y) == 0 ? 0.0f : std::sqrt(1.0f / 3);
    for (const std::string& technique : both_techniques) {
      const Settings settings = {{"reuse", "on"}, {"key_views", "2"}, {"radius", "0.6"}};
      const Frame with = raw_of(technique, frame, settings), without = raw_of(technique, frame, {{"radius", "0.6"}});
      EXPECT_TRUE(key_view_roles(2, 2)[1].is_key);
      EXPECT_FALSE(same_ao(without.views[0], without.views[1])) << "the normals tell them apart";
      EXPECT_TRUE(same_ao(with.views[0], with.views[1])) << name << ", " << technique;
      EXPECT_TRUE(same_ao(with.views[1], without.views[1])) << name << ", " << technique;
    }
  }
}

/// The technique's settings with so many samples that the image hardly changes.
Settings converged(const std::string& technique) { return find_technique(technique).converged; }

/// Gives views normals that no surface has: computed pixels change, reused ones do not.
Frame with_other_normals(Frame frame, const std::vector<KeyViewRole>& roles) {
  for (size_t i = 0; i < roles.size(); ++i) {
    if (roles[i].is_key) continue;
    const Channel& depth = frame.views[i].planes.at("depth").channels[0];
    for (Channel& channel : frame.views[i].planes.at("normal").channels)
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
          channel.at(x, y) = is_background(depth.at(x, y)) ? 0.0f : std::sqrt(1.0f / 3);
  }
  return frame;
}

/// Share of a view's surfaces whose AO is the same in both results.
double share_of_equals(const Frame& a, const Frame& b, const Frame& frame, size_t view) {
  const Channel& depth = frame.views[view].planes.at("depth").channels[0];
  double equal = 0, surfaces = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (is_background(depth.at(x, y))) continue;
      ++surfaces;
      equal += a.views[view].planes.at("ao_raw").channels[0].at(x, y) ==
               b.views[view].planes.at("ao_raw").channels[0].at(x, y);
    }
  }
  return equal / surfaces;
}

TEST(LightFieldReuse, TakesOverWhatKeyViewsShow) {
  const std::vector<KeyViewRole> roles = key_view_roles(9, 4);
  const Frame frame = captured(row_of(9), 160, 128), other = with_other_normals(clone(frame), roles);
  const Settings settings = {{"radius", "0.6"}};
  const auto run_on = [&](const Frame& f, const char* reuse) {
    return raw_of("lightfield-ssao", f, joined(settings, {{"reuse", reuse}}));
  };
  const Frame with = run_on(frame, "on"), with_others = run_on(other, "on");
  const Frame without = run_on(frame, "off"), without_others = run_on(other, "off");
  for (const size_t i : {0, 1, 3, 4, 5, 7, 8}) {
    const double taken = share_of_equals(with, with_others, frame, i);
    const double by_chance = share_of_equals(without, without_others, frame, i);
    std::printf("view %zu: %.3f taken over (%.3f are equal by chance)\n", i, taken, by_chance);
    // Measured: 80 to 98 %; the first and the last view have key views on one side only.
    EXPECT_GT(taken, 0.75) << i;
    EXPECT_LT(by_chance, 0.4) << i;
  }
}

/// Nine modules, every fourth a key view. Measured RMSE, on the views between, to their own converged AO: lightfield-ssao 0.065,
/// computed 0.038; lightfield-hbao+ 0.028, computed 0.010. Another module sees other occluders, and its pixels are half a pixel
/// aside. The key view's own image, unmoved, would have 0.133 and 0.071. From the nearest key view alone lightfield-ssao has
/// 0.069, and from both lightfield-hbao+ 0.026.
TEST(LightFieldReuse, IsNotMuchFurtherFromConvergedThanWithout) {
  const Frame frame = captured(row_of(9), 160, 128);
  const std::vector<KeyViewRole> roles = key_view_roles(9, 4);
  for (const std::string& technique : both_techniques) {
    const Settings radius = {{"radius", "0.6"}};
    const auto taken_from = [&](const char* which) {
      return raw_of(technique, frame, joined(radius, {{"reuse", "on"}, {"reuse_from", which}}));
    };
    const Frame with = raw_of(technique, frame, joined(radius, {{"reuse", "on"}})), both = taken_from("both"),
                nearest = taken_from("nearest");
    const Frame without = raw_of(technique, frame, radius);
    const Frame limit = raw_of(technique, frame, joined(radius, converged(technique)));
    double reused = 0, computed = 0, other = 0, of_both = 0, of_nearest = 0;
    for (size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(same_ao(with.views[i], without.views[i]), roles[i].is_key) << technique << ", view " << i;
      if (roles[i].is_key) continue;
      reused += rmse(with.views[i], limit.views[i]) / 7;
      of_both += rmse(both.views[i], limit.views[i]) / 7;
      of_nearest += rmse(nearest.views[i], limit.views[i]) / 7;
      computed += rmse(without.views[i], limit.views[i]) / 7;
      other += rmse(without.views[size_t(roles[i].nearest)], limit.views[i]) / 7;
    }
    std::printf("%s: RMSE to converged, reused %.4f, computed %.4f, of another view %.4f\n", technique.c_str(), reused,
                computed, other);
    EXPECT_LT(reused, computed + 0.0285) << technique;
    EXPECT_LT(reused, 0.55 * other) << technique;
    EXPECT_LT(of_both, 0.97 * of_nearest) << technique << ": a mean has less noise";
  }
}

TEST(LightFieldReuse, AnyNumberOfViews) {
  const Settings radius = {{"radius", "0.6"}};
  for (const int count : {1, 2, 3, 5}) {
    const Frame frame = captured(row_of(count), 80, 64);
    const Frame without = raw_of("lightfield-ssao", frame, radius);
    for (const int spacing : {2, 3, 64}) {
      SCOPED_TRACE(fmt::format("{} views, every {}th", count, spacing));
      const Frame with = raw_of("lightfield-ssao", frame,
                                joined(radius, {{"reuse", "on"}, {"key_views", fmt::format("{}", spacing)}}));
      EXPECT_EQ(violation(with), "");
      ASSERT_EQ(with.views.size(), size_t(count));
      const std::vector<KeyViewRole> roles = key_view_roles(count, spacing);
      for (size_t i = 0; i < size_t(count); ++i) {
        EXPECT_EQ(with.views[i].name, frame.views[i].name);
        if (roles[i].is_key || count == 1) {
          EXPECT_TRUE(same_ao(with.views[i], without.views[i])) << i;
        }
        EXPECT_LT(rmse(with.views[i], without.views[i]), 0.15) << i;
      }
    }
  }
}

/// Blocks, other ones in each view.
void mask_blocks(Frame& frame) {
  for (size_t i = 0; i < frame.views.size(); ++i) {
    Plane mask{"mask", {}};
    mask.channels.emplace_back(Layout(frame.width(), frame.height()));
    for (int y = 0; y < frame.height(); ++y)
      for (int x = 0; x < frame.width(); ++x) mask.channels[0].at(x, y) = (x / 12 + y / 9 + int(i)) % 3 == 0;
    frame.views[i].planes.insert_or_assign("mask", std::move(mask));
  }
}

TEST(LightFieldReuse, InsideAMaskNoBitChanges) {
  Frame frame = captured(row_of(5), 160, 128);
  mask_blocks(frame);
  for (const std::string& technique : both_techniques) {
    for (const char* reuse : {"off", "on"}) {
      const auto with = [&](const std::string& mask) {
        const Settings settings = {{"radius", "0.6"}, {"reuse", reuse}, {"key_views", "2"}};
        return run(make_plan({.outputs = {technique}, .filter = "none", .settings = settings, .only = mask},
                             plane_names(frame), "the frame has not"),
                   frame, device(), {.math = Math::precise});
      };
      const RunResult masked = with("mask"), whole = with("");
      EXPECT_GT(masked.skipped_share, 0.1) << technique << ", reuse=" << reuse;
      int occluded = 0;
      for (size_t i = 0; i < frame.views.size(); ++i) {
        const Channel& mask = frame.views[i].planes.at("mask").channels[0];
        const Channel &found = masked.frame.views[i].planes.at("ao_raw").channels[0],
                      &expected = whole.frame.views[i].planes.at("ao_raw").channels[0];
        for (int y = 0; y < frame.height(); ++y) {
          for (int x = 0; x < frame.width(); ++x) {
            ASSERT_EQ(found.at(x, y), mask.at(x, y) > 0 ? expected.at(x, y) : 1)
                << technique << ", reuse=" << reuse << ", view " << i << ": " << x << ", " << y;
            occluded += mask.at(x, y) > 0 && found.at(x, y) < 0.9;
          }
        }
      }
      EXPECT_GT(occluded, 500);
    }
  }
}

/// A view without a pose cannot be found in the others.
TEST(LightFieldReuse, NeedsToKnowWhereViewsStand) {
  const Shot shot = perspective(40, 30);
  const std::array<Eye, 2> eyes = {eye_at(shot, {-0.05, 0, 0}, -1), eye_at(shot, {0.05, 0, 0}, 1)};
  Frame frame = shoot_pair(eyes, room(), [](const dvec3&) { return 1.0; });
  for (View& view : frame.views) view.camera->pose.reset(), view.planes.erase("position");
  EXPECT_NO_THROW(raw_of("lightfield-hbao+", frame, {}));
  try {
    raw_of("lightfield-hbao+", frame, {{"reuse", "on"}});
    FAIL() << "the other view's AO as it is";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("without a pose"), std::string::npos) << error.what();
  }
}

/// The same view twice, one with other normals: pixels computed there would differ.
TEST(LightFieldReuse, AtHalfResolution) {
  const Shot shot = perspective(121, 90);
  const std::array<Eye, 2> eyes = {eye_at(shot, {0, 0, 0}, -1), eye_at(shot, {0, 0, 0}, 1)};
  const Frame frame =
      with_other_normals(shoot_pair(eyes, room(), [](const dvec3&) { return 1.0; }), key_view_roles(2, 2));
  const auto with = [&](const char* reuse) {
    const Plan plan = make_plan({.outputs = {"lightfield-hbao+"},
                                 .filter = "none",
                                 .settings = {{"reuse", reuse}, {"key_views", "2"}},
                                 .resolution = 2},
                                plane_names(frame), "the frame has not");
    return std::move(run(plan, frame, device(), {.math = Math::precise}).frame);
  };
  const Frame reused = with("on"), computed = with("off");
  EXPECT_TRUE(same_ao(reused.views[1], computed.views[1]));
  const double off = rmse(reused.views[0], reused.views[1]), other = rmse(computed.views[0], computed.views[1]);
  std::printf("half resolution: RMSE to the key view %.4f, computed %.4f\n", off, other);
  EXPECT_GT(other, 0.1);
  // Upsampling sees the normals: 0.032.
  EXPECT_LT(off, 0.2 * other);
}

TEST(LightFieldMask, LeavesOutNothingThatIsOccluded) {
  for (const auto& [name, display] : display_cases()) {
    const Frame frame = captured(display, 240, 180);
    const Frame ao = raw_of("lightfield-hbao+", frame, {{"radius", "0.6"}});
    const Frame found = run(make_plan({.outputs = {"lightfield-mask"}, .settings = {{"radius", "0.6"}}},
                                      plane_names(frame), "the frame has not"),
                            frame, device(), {})
                            .frame;
    int left_out = 0, occluded = 0, wanted = 0;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 240; ++x) {
        const bool is_wanted = found.views[0].planes.at("mask").channels[0].at(x, y) > 0;
        const bool is_occluded = raw_at(ao, x, y) < 1 - 1.0 / 255;
        wanted += is_wanted, occluded += is_occluded, left_out += is_occluded && !is_wanted;
      }
    }
    std::printf("%s: %d occluded, %d wanted, %d left out\n", name.c_str(), occluded, wanted, left_out);
    EXPECT_GT(occluded, 1000) << name;
    EXPECT_LT(wanted, 240 * 180 * 0.95) << name << ": something has to be left out";
    EXPECT_LE(left_out, 0.005 * 240 * 180) << name;
  }
}

TEST(LightFieldReuse, SameBitsAtEveryWidth) {
  for (const auto& [name, display] : display_cases()) {
    LightFieldDisplay pair = display;
    pair.modules.push_back(display.modules[0]);
    pair.modules[1].position.x += 0.2;
    const Frame frame = captured(pair, 80, 64);
    for (const std::string& technique : both_techniques) {
      const auto with = [&](int lanes) {
        return raw_of(technique, frame, {{"radius", "0.6"}, {"reuse", "on"}, {"key_views", "2"}},
                      {.math = Math::precise, .lanes = lanes});
      };
      const Frame one = with(1);
      for (const int lanes : {4, 16}) {
        const Frame wide = with(lanes);
        for (const size_t view : {0, 1}) {
          EXPECT_TRUE(same_ao(one.views[view], wide.views[view])) << name << ", " << technique << ", " << lanes;
        }
      }
    }
  }
}

/// Nine views have key views at the same distances from both ends; the middle one may count either as the nearest.
TEST(LightFieldReuse, ViewsInReverseOrder) {
  Frame frame = captured(row_of(9), 80, 64);
  const Settings settings = {{"radius", "0.6"}, {"reuse", "on"}};
  const Frame forward = raw_of("lightfield-ssao", frame, settings);
  std::reverse(frame.views.begin(), frame.views.end());
  const Frame backward = raw_of("lightfield-ssao", frame, settings);
  for (size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(backward.views[i].name, forward.views[8 - i].name);
    if (i != 4) {
      EXPECT_TRUE(same_ao(backward.views[i], forward.views[8 - i])) << i;
    }
  }
}

TEST(LightFieldReuse, AViewThatShowsNothing) {
  for (const size_t empty : {0, 1, 2}) {
    Frame frame = captured(row_of(3), 80, 64);
    for (const auto& [plane, value] : {std::pair{"depth", INFINITY}, {"normal", 0.0f}, {"position", 0.0f}})
      for (Channel& channel : frame.views[empty].planes.at(plane).channels) channel = Channel(channel.layout(), value);
    const Frame with = raw_of("lightfield-hbao+", frame, {{"radius", "0.6"}, {"reuse", "on"}, {"key_views", "2"}});
    const Frame without = raw_of("lightfield-hbao+", frame, {{"radius", "0.6"}});
    EXPECT_EQ(violation(with), "");
    for (size_t i = 0; i < 3; ++i) EXPECT_LT(rmse(with.views[i], without.views[i]), i == empty ? 1e-9 : 0.15) << i;
    EXPECT_EQ(rmse(with.views[1], without.views[1]), 0) << "the key view";
    // Views beside an empty key view have nothing to reuse, and are computed.
    if (empty != 1) continue;
    EXPECT_TRUE(same_ao(with.views[0], without.views[0]));
    EXPECT_TRUE(same_ao(with.views[2], without.views[2]));
  }
}

/// Eyes far from the world's origin, parallel and turned towards each other.
TEST(LightFieldReuse, ViewsOfCameras) {
  const Shot shot = perspective(120, 90);
  for (const double apart : {0.0, 1e7}) {
    const std::array<Eye, 2> eyes = {eye_at(shot, {apart - 0.05, 0, 0}, -1), eye_at(shot, {apart + 0.05, 0, 0}, 1)};
    const test::Scene moved = [apart](const EyeRay& ray) {
      return room()({ray.origin - dvec3(apart, 0, 0), ray.direction});
    };
    const Frame frame = shoot_pair(eyes, moved, [](const dvec3&) { return 1.0; });
    for (const std::string& technique : both_techniques) {
      const Settings settings = converged(technique);
      const Frame without = raw_of(technique, frame, settings);
      const Frame with = raw_of(technique, frame, joined(settings, {{"reuse", "on"}, {"key_views", "2"}}));
      EXPECT_TRUE(same_ao(with.views[1], without.views[1]));
      EXPECT_FALSE(same_ao(with.views[0], without.views[0])) << "something is taken over";
      const double off = rmse(with.views[0], without.views[0]), other = rmse(without.views[1], without.views[0]);
      std::printf("%s, cameras at %g: RMSE to computed %.4f, of the other eye %.4f\n", technique.c_str(), apart, off,
                  other);
      EXPECT_LT(off, 0.6 * other) << technique;
    }
  }
}

}  // namespace
}  // namespace gloam::test::light_field_test
