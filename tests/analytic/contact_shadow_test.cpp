// Contact shadows against closed forms: open planes, a ball over a floor, strips before a wall, lights at a place, and both kinds of camera.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "gloam/error.h"
#include "support/estimate.h"

namespace gloam::test::contact_shadow_test {
namespace {

using glm::dvec3;

/// One sample for each pixel of a ray.
const Settings limit = {{"length", "1"}, {"steps", "1024"}, {"max_reach", "1"}, {"jitter", "off"}};

Settings from_light(const std::string& kind, const dvec3& light, const Settings& more = {}) {
  Settings settings = joined(limit, {{"light", kind},
                                     {"light_x", std::to_string(light.x)},
                                     {"light_y", std::to_string(light.y)},
                                     {"light_z", std::to_string(light.z)}});
  return joined(settings, more);
}

Frame contact_of(const Frame& frame, const Settings& settings) {
  return run(plan_of("contact-shadow", frame, settings, {"contact"}), frame, device(), {.math = Math::precise}).frame;
}

float contact_at(const Frame& frame, int x, int y) { return value_at(frame, "contact", x, y); }

struct Shares {
  double lit = 0, dark = 0;
};

Shares shares_of(const Frame& result) {
  Shares shares;
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      shares.lit += contact_at(result, x, y) == 1;
      shares.dark += contact_at(result, x, y) == 0;
    }
  }
  const double all = double(result.width()) * result.height();
  return {shares.lit / all, shares.dark / all};
}

TEST(ContactShadow, AnOpenPlaneIsLitByAnyLightAboveItAndDarkBelow) {
  for (const Shot& shot : usual_shots()) {
    for (const double tilt : {0.0, 0.4, 0.8}) {
      const Frame frame = shoot(shot, tilted_plane(4, tilt, 0.7));
      const dvec3 normal = vector_at(frame, "normal", 40, 30),
                  aside = glm::normalize(glm::cross(normal, {0.3, 1, 0.1}));
      for (const double elevation : {0.02, 0.3, 1.0, 1.57}) {
        for (const double sign : {-1.0, 1.0}) {
          const dvec3 light = std::sin(elevation) * normal + sign * std::cos(elevation) * aside;
          const Settings usual = from_light("directional", 100.0 * light, {{"jitter", "on"}});
          EXPECT_EQ(shares_of(contact_of(frame, usual)).lit, 1) << tilt << " " << elevation << " " << sign;
          const dvec3 behind = aside * sign * std::cos(elevation) - std::sin(elevation) * normal;
          EXPECT_EQ(shares_of(contact_of(frame, from_light("directional", 100.0 * behind))).dark, 1);
        }
      }
    }
  }
}

constexpr double wall = 4, before = 0.4, half_width = 0.15;

/// A strip as high as the image and 2 x 0.15 wide, before a wall.
Scene strip_before_wall() {
  return nearest_of({within(tilted_plane(wall - before, 0, 0), half_width, 100), tilted_plane(wall, 0, 0)});
}

/// Compares the wall with a closed form; the light passes the plane of the strip at `passes(x, y)` of a point (x, y) of the wall. Pixels
/// whose rays pass an edge of the strip by less than two pixels may be either.
template <typename Passes>
void expect_shadow_of_strip(const Shot& shot, const Settings& settings, const Passes& passes) {
  const Frame frame = shoot(shot, strip_before_wall());
  const Frame result = contact_of(frame, settings);
  const double pixel = wall / shot.camera.fx * (shot.camera.orthographic ? 1 / wall : 1);
  int shaded = 0, lit = 0;
  // Rays of the rows above and below may leave the image before they reach the strip.
  for (int y = 30; y < shot.height - 30; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (value_at(frame, "depth", x, y) != float(wall)) continue;
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const dvec3 point = ray.origin + wall * ray.direction;
      const double from_edge = half_width - std::abs(passes(point));
      if (std::abs(from_edge) < 2 * pixel) continue;
      ASSERT_EQ(contact_at(result, x, y), from_edge > 0 ? 0 : 1) << x << "," << y;
      (from_edge > 0 ? shaded : lit) += 1;
    }
  }
  // The strip hides a part of its shadow.
  EXPECT_GT(shaded, 0.02 * shot.width * shot.height);
  EXPECT_GT(lit, 0.5 * shot.width * shot.height);
}

std::vector<Shot> large_shots() { return {perspective(240, 180), orthographic(240, 180, 4)}; }

// Next to nothing behind its front: rays meet the strip where they pass its pixels.
const Settings thin = {{"thickness", "0.0001"}};

TEST(ContactShadow, AStripShadesTheWallWhereADirectionalLightPassesIt) {
  const dvec3 light(0.8, 0.3, 1);
  for (const Shot& shot : large_shots()) {
    expect_shadow_of_strip(shot, from_light("directional", light, thin),
                           [&](const dvec3& p) { return p.x + before * light.x / light.z; });
  }
}

TEST(ContactShadow, AStripShadesTheWallWhereALightAtAPlacePassesIt) {
  const dvec3 light(0.8, 0.1, -3);  // at a depth of 3
  for (const Shot& shot : large_shots()) {
    expect_shadow_of_strip(shot, from_light("point", light, joined(thin, {{"length", "100"}})),
                           [&](const dvec3& p) { return p.x + before * (light.x - p.x) / (light.z + wall); });
  }
}

TEST(ContactShadow, WhatIsBeyondTheLengthOrTheLightDoesNotShade) {
  const Frame frame = shoot(perspective(240, 180), strip_before_wall());
  const auto lit_of_wall = [&](const Settings& settings) {
    const Frame result = contact_of(frame, joined(settings, thin));
    int dark = 0;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 240; ++x)
        dark += value_at(frame, "depth", x, y) == float(wall) && contact_at(result, x, y) == 0;
    }
    return dark;
  };
  // Towards (0.8, 0.3, 1) the strip is 0.526 away.
  EXPECT_GT(lit_of_wall(from_light("directional", {0.8, 0.3, 1}, {{"length", "0.55"}})), 0);
  EXPECT_EQ(lit_of_wall(from_light("directional", {0.8, 0.3, 1}, {{"length", "0.5"}})), 0);
  // A light between the wall and the strip.
  EXPECT_EQ(lit_of_wall(from_light("point", {0.3, 0, -wall + 0.3})), 0);
}

TEST(ContactShadow, ABallShadesTheFloorInAnEllipse) {
  const dvec3 centre(0.2, 0, -3.5), light = glm::normalize(dvec3(0.6, 0.2, 1));
  constexpr double radius = 0.25;
  const Shot shot = perspective(240, 180);
  const Frame frame = shoot(shot, nearest_of({ball(centre, radius), tilted_plane(wall, 0, 0)}));
  // As thick as the ball is.
  const Frame result = contact_of(frame, from_light("directional", light, {{"thickness", "0.4"}}));
  int wrong = 0, shaded = 0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (value_at(frame, "depth", x, y) != float(wall)) continue;
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const dvec3 to_centre = centre - (ray.origin + wall * ray.direction);
      const bool meets = glm::length(to_centre - glm::dot(to_centre, light) * light) < radius;
      shaded += meets;
      wrong += contact_at(result, x, y) != (meets ? 0 : 1);
    }
  }
  std::printf("ball before a wall: %d shaded pixels, %d wrong\n", shaded, wrong);
  EXPECT_GT(shaded, 300);
  EXPECT_LT(wrong, 0.16 * shaded);
}

TEST(ContactShadow, ALightInASurfaceOrAtThePointIsNoSpecialCase) {
  const Shot shot = perspective(81, 61);
  const Frame frame = shoot(shot, tilted_plane(4, 0, 0));
  // At the point that the pixel in the middle shows: lit there, behind or along the surface elsewhere.
  const Frame at = contact_of(frame, from_light("point", {0, 0, -4}));
  EXPECT_EQ(contact_at(at, 40, 30), 1);
  EXPECT_EQ(shares_of(at).dark, 1 - 1.0 / (81 * 61));
  EXPECT_EQ(shares_of(contact_of(frame, from_light("point", {0, 0, -5}))).dark, 1);
  EXPECT_EQ(shares_of(contact_of(frame, from_light("point", {0, 0, 1}))).lit, 1) << "behind the eye";
  const Frame before_ball = shoot(shot, nearest_of({ball({0, 0, -3.5}, 0.3), tilted_plane(4, 0, 0)}));
  const Frame in_ball = contact_of(before_ball, from_light("point", {0, 0, -3.5}, {{"thickness", "10"}}));
  EXPECT_EQ(contact_at(in_ball, 40, 30), 0) << "the ball's own surface faces away";
}

TEST(ContactShadow, ADirectionOfTheWorldIsTurnedIntoTheView) {
  Frame frame = shoot(perspective(80, 60), room());
  const Frame expected = contact_of(frame, from_light("directional", {0.25, 0.5, 0.5}, {{"light_in", "view"}}));
  // x of the world is y of the view, y is -x.
  Pose pose;
  pose.world_to_view = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1);
  pose.position = {10, -20, 30};
  frame.views[0].camera->pose = pose;
  const Frame turned = contact_of(frame, from_light("directional", {0.5, -0.25, 0.5}));
  frame.views[0].light = glm::normalize(dvec3(0.5, -0.25, 0.5));
  const Frame sun = contact_of(frame, limit);
  const Frame place = contact_of(frame, from_light("point", dvec3(10, -20, 30) + dvec3(0.5, -0.25, 0.5)));
  const Frame place_expected = contact_of(frame, from_light("point", {0.25, 0.5, 0.5}, {{"light_in", "view"}}));
  EXPECT_GT(shares_of(expected).dark, 0.01);
  EXPECT_GT(shares_of(expected).lit, 0.05);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      ASSERT_EQ(contact_at(turned, x, y), contact_at(expected, x, y));
      ASSERT_EQ(contact_at(sun, x, y), contact_at(expected, x, y));
      ASSERT_EQ(contact_at(place, x, y), contact_at(place_expected, x, y));
    }
  }
}

TEST(ContactShadow, RefusesADirectionOfNoLength) {
  const Frame frame = shoot(perspective(80, 60), room());
  try {
    plan_of("contact-shadow", frame, from_light("directional", {0, 0, 0}), {"contact"});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("light_x, light_y and light_z are all 0"), std::string::npos);
  }
}

TEST(ContactShadow, TheMaskHasNearlyAllShadows) {
  for (const Shot& shot : large_shots()) {
    const Frame frame = shoot(shot, room());
    const Settings light = {{"light", "directional"}, {"light_x", "-1"}, {"light_y", "0.5"}, {"light_z", "0.4"}};
    const Frame all = contact_of(frame, joined(light, {{"steps", "64"}}));
    const Frame unshaded = contact_of(frame, joined(light, {{"length", "0"}}));
    const Frame mask = run(plan_of("contact-mask", frame, light, {"mask"}), frame, device()).frame;
    double missed = 0, wanted = 0, shaded = 0;
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const bool is_shaded = contact_at(all, x, y) != contact_at(unshaded, x, y),
                   wants = value_at(mask, "mask", x, y) == 1;
        shaded += is_shaded;
        wanted += wants;
        missed += is_shaded && !wants;
      }
    }
    const double pixels = double(shot.width) * shot.height;
    std::printf("contact-mask on the room: %.1f %% shaded, %.1f %% wanted, %.2f %% missed\n", 100 * shaded / pixels,
                100 * wanted / pixels, 100 * missed / pixels);
    EXPECT_GT(shaded, 0.01 * pixels);
    EXPECT_LT(missed, 0.0005 * pixels);
    EXPECT_LT(wanted, 0.25 * pixels);
  }
}

}  // namespace
}  // namespace gloam::test::contact_shadow_test
