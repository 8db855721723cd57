// The stereo inconsistency error against closed forms: each eye's image of a painted world is known exactly.
#include "gloam/stereo_consistency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "support/stress.h"
#include "unit/message_of.h"

namespace gloam::test::stereo_consistency_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr int width = 96, height = 64;

const Scene wall = tilted_plane(4, 0, 0);
double slope(const glm::dvec3& p) { return 0.5 + 0.11 * p.x + 0.07 * p.y + 0.05 * p.z; }

/// Irregular, and the same for pixels of both eyes at the same position in the image only.
void make_noise(Plane& plane) {
  unsigned state = 1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      state = state * 1664525u + 1013904223u;
      plane.channels[0].at(x, y) = float(state >> 8) * 0x1p-24f;
    }
  }
}

Shot off_axis(double share) {
  Shot shot = perspective(width, height);
  shot.camera.cx += share * width;
  return shot;
}

/// Two eyes side by side; their distance is not a whole number of pixels.
std::array<Eye, 2> side_by_side() {
  const Shot shot = perspective(width, height);
  return {eye_at(shot, {-0.1, 0, 0}), eye_at(shot, {0.123, 0, 0})};
}

StereoPixel pixel_of(const StereoErrors& view, int x, int y) {
  return view.pixels[size_t(y) * size_t(width) + size_t(x)];
}

// ---------------------------------------------------------------------------------------------------------------------

struct Rig {
  const char* name;
  std::array<Eye, 2> eyes;
  Scene world;
  double bound;  ///< of the error of a linear paint
};

/// If the map from eye to eye is affine, interpolating a linear paint is exact. What remains is the float rounding of AO and
/// depth (1e-6), and, away from the rows, the effect of moving a position to a centre 1/1000 pixel away: the paint changes by
/// less than 0.01 per pixel. In perspective the paint is a quotient of linear functions: that bound is measured (9e-5 at most).
std::vector<Rig> rigs() {
  const Shot shot = perspective(width, height), flat = orthographic(width, height, 4);
  const Scene slanted = tilted_plane(4, 0.4, 0.7);
  return {{"side by side", side_by_side(), wall, 1e-6},
          {"one above the other", {eye_at(shot, {0, 0.1, 0}), eye_at(shot, {0, -0.123, 0})}, wall, 1e-6},
          {"off-axis", {eye_at(off_axis(0.06), {-0.1, 0, 0}), eye_at(off_axis(-0.05), {0.1, 0.04, 0})}, wall, 1e-6},
          {"other intrinsics",
           {eye_at(shot, {-0.1, 0, 0}), eye_at(perspective(width, height, 50), {0.1, 0.02, 0.3})},
           wall,
           1e-6},
          {"orthographic", {eye_at(flat, {0, 0, 0}), eye_at(flat, {0.123, 0.05, 0.2}, 15)}, slanted, 1e-5},
          {"orthographic and perspective", {eye_at(flat, {0, 0, 0}), eye_at(shot, {0.1, 0, 0})}, wall, 1e-6},
          {"slanted", side_by_side(), slanted, 2e-4},
          {"toed in", {eye_at(shot, {-0.5, 0, 0}, -7.125), eye_at(shot, {0.5, 0.1, 0}, 7.125)}, slanted, 2e-4}};
}

TEST(StereoConsistency, APaintedPlaneIsTheSameForBothEyes) {
  for (const Rig& rig : rigs()) {
    for (const glm::ivec2& corner : {glm::ivec2(0, 0), glm::ivec2(-40, 1000)}) {
      Frame frame = shoot_pair(rig.eyes, rig.world, slope);
      move_window(frame, corner.x, corner.y);
      const StereoInconsistency result = stereo_inconsistency(frame, "ao");
      SCOPED_TRACE(rig.name);
      EXPECT_LE(result.both.max, rig.bound);
      EXPECT_EQ(result.both.hidden, 0);
      EXPECT_EQ(result.both.edge, 0) << "turned eyes have other view spaces, and the normal is the same";
      EXPECT_EQ(result.both.counted + result.both.outside, 2 * width * height);
      EXPECT_GT(result.both.counted, width * height);
      EXPECT_EQ(result.normal_check, 6);
    }
  }
}

TEST(StereoConsistency, TheErrorOfOneEyeIsTheError) {
  for (const Rig& rig : rigs()) {
    Frame frame = shoot_pair(rig.eyes, rig.world, slope);
    Channel& ao = frame.views[1].planes["ao"].channels[0];
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) ao.at(x, y) -= 0.125f;
    }
    const StereoInconsistency result = stereo_inconsistency(frame, "ao");
    for (const StereoErrors& view : result.views) {
      EXPECT_NEAR(view.figures.mean, 0.125, rig.bound) << rig.name;
      EXPECT_NEAR(view.figures.rmse, 0.125, rig.bound) << rig.name;
      EXPECT_NEAR(view.figures.p99, 0.125, rig.bound) << rig.name;
      EXPECT_NEAR(view.figures.max, 0.125, rig.bound) << rig.name;
    }
  }
}

/// The error equals the bilinear interpolation, between two pixels, of a paint with a kink at a known position.
TEST(StereoConsistency, TheOtherEyesValueIsBilinear) {
  Frame frame = shoot_pair(side_by_side(), wall, [](const glm::dvec3&) { return 0.0; });
  frame.views[1].planes["ao"].channels[0].at(40, 30) = 1;
  const StereoInconsistency result = stereo_inconsistency(frame, "ao", {});
  const double shift = 0.223 * frame.views[0].camera->fx / 4, rest = shift - std::floor(shift);
  const int x = 40 + int(std::floor(shift));
  EXPECT_NEAR(result.views[0].error.at(x, 30), 1 - rest, 1e-5);
  EXPECT_NEAR(result.views[0].error.at(x + 1, 30), rest, 1e-5);
  EXPECT_EQ(result.views[0].error.at(x, 31), 0) << "eyes side by side share their rows";
  EXPECT_EQ(result.views[1].error.at(40, 30), 1);
}

TEST(StereoConsistency, OneEyeTwiceAgreesOnAnyImage) {
  const Eye eye = eye_at(perspective(width, height), {3, 1, 2}, 33);
  Frame frame = shoot_pair({eye, eye}, seen_by(eye_at(eye.shot, {-3, -1, -2}, 0).pose, room()), slope);
  for (View& view : frame.views) make_noise(view.planes["ao"]);
  const StereoInconsistency result = stereo_inconsistency(frame, "ao");
  EXPECT_GT(result.both.surfaces, 1000);
  EXPECT_EQ(result.both.counted, result.both.surfaces) << "pixels at the border and at edges have no neighbours to ask";
  EXPECT_EQ(result.both.max, 0);
}

TEST(StereoConsistency, SwappedEyesSwapTheFigures) {
  Frame frame = shoot_pair(side_by_side(), room(), slope);
  make_noise(frame.views[0].planes["ao"]);
  const StereoInconsistency a = stereo_inconsistency(frame, "ao");
  std::swap(frame.views[0], frame.views[1]);
  const StereoInconsistency b = stereo_inconsistency(frame, "ao");
  EXPECT_NE(a.views[0].figures.mean, a.views[1].figures.mean);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.views[i].figures.mean, b.views[1 - i].figures.mean);
    EXPECT_EQ(a.views[i].figures.counted, b.views[1 - i].figures.counted);
    EXPECT_EQ(a.views[i].pixels, b.views[1 - i].pixels);
  }
  EXPECT_NEAR(a.both.mean, b.both.mean, 1e-12);
}

/// Turned eyes at positions that are exact in double that far away: what remains is the way they are subtracted.
TEST(StereoConsistency, FarFromTheOriginNothingChanges) {
  const Shot shot = perspective(width, height);
  Frame frame = shoot_pair({eye_at(shot, {-0.125, 0, 0}, -5), eye_at(shot, {0.125, 0, 0}, 5)}, room(), slope);
  make_noise(frame.views[0].planes["ao"]);
  const StereoInconsistency near = stereo_inconsistency(frame, "ao");
  EXPECT_GT(near.both.mean, 0.1) << "noise";
  EXPECT_GT(near.both.hidden, 50);
  for (const double distance : {1e7, 0x1p40}) {
    Frame moved = clone(frame);
    for (View& view : moved.views) view.camera->pose->position += distance * glm::dvec3(1, -1, 1);
    const StereoInconsistency far = stereo_inconsistency(moved, "ao");
    EXPECT_EQ(near.both.mean, far.both.mean) << distance;
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(near.views[i].pixels, far.views[i].pixels) << distance;
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// What counts

/// A card stands before the wall. The wall's pixels that the other eye sees are known; those within two pixels of the card's
/// outline are left out.
TEST(StereoConsistency, WhatTheOtherEyeDoesNotSeeIsRejected) {
  const std::array<Eye, 2> eyes = side_by_side();
  const Scene world = nearest_of({wall, within(tilted_plane(2, 0, 0), 0.3, 0.4)});
  const auto paint = [](const glm::dvec3& p) { return p.z > -3 ? 0.25 : 0.75; };
  const StereoInconsistency result = stereo_inconsistency(shoot_pair(eyes, world, paint), "ao");
  for (size_t i = 0; i < 2; ++i) {
    const Eye &own = eyes[i], &other = eyes[1 - i];
    const Scene seen = seen_by(own.pose, world), seen_there = seen_by(other.pose, world);
    int hidden = 0, counted = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double depth = seen(ray_through(own.shot, x + 0.5, y + 0.5))->depth;
        const double there = x + 0.5 + own.shot.camera.fx * (own.pose.position.x - other.pose.position.x) / depth;
        if (there < 1 || there > width - 1) continue;
        const auto depth_there = [&](double dx, double dy) {
          return seen_there(ray_through(other.shot, there + dx, y + 0.5 + dy))->depth;
        };
        const double middle = depth_there(0, 0);
        if (depth_there(-2, 0) != middle || depth_there(2, 0) != middle || depth_there(0, -2) != middle ||
            depth_there(0, 2) != middle)
          continue;
        const bool is_seen = std::abs(middle - depth) < 1e-9;
        EXPECT_EQ(pixel_of(result.views[i], x, y), is_seen ? StereoPixel::counted : StereoPixel::hidden)
            << x << " " << y;
        hidden += !is_seen;
        counted += is_seen;
        const float error = result.views[i].error.at(x, y);
        EXPECT_TRUE(is_seen ? error < 1e-6f : std::isnan(error)) << x << " " << y << " " << error;
      }
    }
    EXPECT_GT(hidden, 50);
    EXPECT_GT(counted, 3000);
  }
}

/// An orthographic eye turned by 75 degrees sees a wall 1 / cos(75) times as narrow: that many pixels of the first eye share one
/// pixel there, and those within 1 pixel of its centre come back.
TEST(StereoConsistency, PixelsThatShareOneOfTheOtherEyesAreNotAllCounted) {
  const Shot flat = orthographic(width, height, 4);
  const double turn = 75, cosine = std::cos(glm::radians(turn));
  const Eye aside = eye_at(flat, {4 * std::tan(glm::radians(turn)), 0, 0}, turn);
  const StereoInconsistency result =
      stereo_inconsistency(shoot_pair({eye_at(flat, {0, 0, 0}), aside}, wall, slope), "ao");
  const StereoFigures& f = result.views[0].figures;
  EXPECT_EQ(f.outside, 0);
  EXPECT_EQ(f.edge, 0);
  EXPECT_NEAR(f.rejected_share(), 1 - 2 * cosine, 0.02);
  EXPECT_EQ(result.views[1].figures.hidden, 0) << "the other way each pixel has a pixel of its own";
}

/// A roof's ridge, at depth 4 and x = 0: surfaces lie beside each other in depth, and their normals 90 degrees apart.
std::optional<Surface> roof(const EyeRay& ray) {
  const auto left = tilted_plane(4, -0.25 * std::numbers::pi, 0)(ray);
  const auto right = tilted_plane(4, 0.25 * std::numbers::pi, 0)(ray);
  return left->depth > right->depth ? left : right;
}

TEST(StereoConsistency, TheNormalCheckRejectsACrease) {
  const std::array<Eye, 2> eyes = side_by_side();
  const Frame frame = shoot_pair(eyes, roof, [](const glm::dvec3& p) { return p.x < 0 ? 0.25 : 0.75; });
  const StereoInconsistency with = stereo_inconsistency(frame, "ao");
  const StereoInconsistency without = stereo_inconsistency(frame, "ao", {.normal_check = {}});
  const StereoInconsistency wide = stereo_inconsistency(frame, "ao", {.normal_check = 91});
  // One column of pixels in each view lands beside the ridge.
  for (const StereoErrors& view : with.views) EXPECT_EQ(view.figures.edge, height);
  EXPECT_LT(with.both.max, 1e-6);
  EXPECT_EQ(without.both.edge, 0);
  EXPECT_EQ(without.both.counted, with.both.counted + with.both.edge);
  EXPECT_GT(without.both.max, 0.1);
  EXPECT_FALSE(without.normal_check);
  EXPECT_EQ(wide.both.edge, 0);
  EXPECT_EQ(wide.both.mean, without.both.mean);
}

/// The normals of the other view are turned by a known angle.
TEST(StereoConsistency, TheNormalCheckIsInDegrees) {
  Frame frame = shoot_pair(side_by_side(), wall, slope);
  Plane& normal = frame.views[1].planes["normal"];
  const double angle = glm::radians(4.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {  // of any length
      normal.channels[1].at(x, y) = float(0.3 * std::sin(angle));
      normal.channels[2].at(x, y) = float(0.3 * std::cos(angle));
    }
  }
  EXPECT_EQ(stereo_inconsistency(frame, "ao", {.normal_check = 4.01}).both.edge, 0);
  EXPECT_NE(message_of([&] { stereo_inconsistency(frame, "ao", {.normal_check = 3.99}); }).find("no surface in common"),
            std::string::npos);
}

TEST(StereoConsistency, NeighboursHaveToBeSurfaces) {
  const Scene card = within(wall, 0.6, 0.5);
  const Frame frame = shoot_pair(side_by_side(), card, slope);
  for (const auto& check : {StereoOptions{}, StereoOptions{.normal_check = {}}}) {
    const StereoInconsistency result = stereo_inconsistency(frame, "ao", check);
    EXPECT_GT(result.both.edge, 0);
    EXPECT_LT(result.both.max, 1e-6) << "what stands on the background says nothing";
    EXPECT_GT(double(result.both.counted), 0.8 * double(result.both.surfaces));
  }
}

TEST(StereoConsistency, WithoutNormalsThereIsNoNormalCheck) {
  Frame frame = shoot_pair(side_by_side(), roof, slope);
  const long long counted = stereo_inconsistency(frame, "ao", {.normal_check = {}}).both.counted;
  frame.views[1].planes.erase("normal");
  const StereoInconsistency result = stereo_inconsistency(frame, "ao");
  EXPECT_FALSE(result.normal_check);
  EXPECT_EQ(result.both.counted, counted);
}

// ---------------------------------------------------------------------------------------------------------------------
// Figures

TEST(StereoConsistency, FiguresAreThoseOfTheErrors) {
  const Eye eye = eye_at(perspective(10, 10), {0, 0, 0});
  Frame frame = shoot_pair({eye, eye}, wall, [](const glm::dvec3&) { return 0.25; });
  Channel& ao = frame.views[1].planes["ao"].channels[0];
  ao.at(3, 4) = 0.75f;  // 1 of 100
  const StereoFigures one = stereo_inconsistency(frame, "ao").both;
  EXPECT_EQ(one.counted, 200);
  EXPECT_DOUBLE_EQ(one.mean, 0.005);
  EXPECT_DOUBLE_EQ(one.rmse, std::sqrt(0.25 / 100));
  EXPECT_EQ(one.p99, 0);
  EXPECT_EQ(one.max, 0.5);
  ao.at(9, 9) = 0;  // 2 of 100
  const StereoInconsistency two = stereo_inconsistency(frame, "ao");
  EXPECT_EQ(two.both.p99, 0.25);
  EXPECT_DOUBLE_EQ(two.both.mean, 0.0075);
  EXPECT_DOUBLE_EQ(two.views[0].figures.mean, 0.0075);
}

TEST(StereoConsistency, OfSeveralComponentsTheLengthOfTheDifferenceCounts) {
  const Eye eye = eye_at(perspective(10, 10), {0, 0, 0});
  Frame frame = shoot_pair({eye, eye}, wall, slope);
  for (size_t i = 0; i < 2; ++i) {
    for (const float value : {0.3f, 0.4f, 1.0f})
      frame.views[i].planes["color"].channels.emplace_back(Layout(10, 10), i && value < 1 ? 2 * value : value);
  }
  EXPECT_NEAR(stereo_inconsistency(frame, "color").both.mean, 0.5, 1e-7);
}

/// In their own view spaces the normals of one wall differ by the angle between the eyes.
TEST(StereoConsistency, DirectionsAreComparedInOneSpace) {
  const Shot shot = perspective(width, height);
  Frame frame = shoot_pair({eye_at(shot, {-0.5, 0, 0}, -7), eye_at(shot, {0.5, 0, 0}, 7)}, wall, slope);
  for (View& view : frame.views) view.planes["bent_normal"] = view.planes["normal"].clone();
  EXPECT_LT(stereo_inconsistency(frame, "bent_normal").both.max, 1e-6);
}

// ---------------------------------------------------------------------------------------------------------------------
// Refusals

void expect_refused(const std::function<void(Frame&)>& spoil, const std::string& words) {
  Frame frame = shoot_pair(side_by_side(), wall, slope);
  spoil(frame);
  const std::string message = message_of([&] { stereo_inconsistency(frame, "ao"); });
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(StereoConsistency, WhatIsMissingIsNamed) {
  expect_refused([](Frame& f) { f.views.pop_back(); }, "between two views, and the frame has 1");
  expect_refused([](Frame& f) { f.views[1].camera->pose.reset(); }, "view 'right' has no camera with a pose");
  expect_refused([](Frame& f) { f.views[0].camera.reset(); }, "view 'left' has no camera with a pose");
  expect_refused([](Frame& f) { f.views[1].planes.erase("depth"); }, "view 'right' has no depth");
  expect_refused([](Frame& f) { f.views[0].planes.erase("ao"); }, "view 'left' has no ao");
  expect_refused([](Frame& f) { f.views[1].planes["ao"].channels[0] = Channel(Layout(10, 10), 0); },
                 "'ao' of view 'right' is 10x10, and the frame is 96x64");
  expect_refused([](Frame& f) { f.views[1].planes["ao"].channels.emplace_back(Layout(width, height), 0); },
                 "1 components in one view and 2 in the other");
}

TEST(StereoConsistency, EyesWithNothingInCommonAreRefused) {
  expect_refused([](Frame& f) { f.views[1].camera->pose->position.x += 100; }, "no surface in common");
  expect_refused([](Frame& f) { f.views[1].camera->pose->world_to_view = eye_at({}, {}, 180).pose.world_to_view; },
                 "no surface in common");
}

/// The second eye stands behind the wall that the first one sees. To orthographic eyes what is behind them would lie in
/// the same pixels.
TEST(StereoConsistency, WhatIsBehindTheOtherEyeIsNotInCommon) {
  const Shot flat = orthographic(width, height, 4);
  const Scene walls = nearest_of({wall, tilted_plane(8, 0, 0)});
  const Frame frame = shoot_pair({eye_at(flat, {0, 0, 0}), eye_at(flat, {0, 0, -5})}, walls, slope);
  ASSERT_EQ(frame.views[1].find("depth")->channels[0].at(10, 10), 3) << "the wall behind";
  const std::string message = message_of([&] { stereo_inconsistency(frame, "ao"); });
  EXPECT_NE(message.find("no surface in common"), std::string::npos) << message;
}

TEST(StereoConsistency, ValuesThatAreNotFiniteAreNamedWhereTheyCount) {
  expect_refused([](Frame& f) { f.views[0].planes["ao"].channels[0].at(40, 20) = nan; },
                 "'ao' is not finite at pixel (40, 20) of view 'left'");
  Frame frame = shoot_pair(side_by_side(), within(wall, 0.6, 0.5), slope);
  for (View& view : frame.views) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (is_background(view.planes["depth"].channels[0].at(x, y))) view.planes["ao"].channels[0].at(x, y) = nan;
      }
    }
  }
  EXPECT_LT(stereo_inconsistency(frame, "ao").both.max, 1e-6);
}

}  // namespace
}  // namespace gloam::test::stereo_consistency_test
