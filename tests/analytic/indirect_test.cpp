// Indirect light against closed forms, and against what closes the same directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gloam/planes.h"
#include "support/estimate.h"

namespace gloam::test::indirect_test {
namespace {

constexpr double radius = 0.8, pi = std::numbers::pi;
const Settings limit = {{"radius", "0.8"}, {"directions", "32"}, {"steps", "64"}, {"rays", "4"}, {"thickness", "100"}};

using Color = std::array<float, 3>;

/// Sets the colour of every pixel.
template <typename ColorAt>
void paint(Frame& frame, const ColorAt& color_at) {
  Plane& color = plane_of(frame, "color");
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const Color c = color_at(x, y);
      for (size_t i = 0; i < 3; ++i) color.channels[i].at(x, y) = c[i];
    }
  }
}

Frame painted(const Shot& shot, const Scene& scene, const Color& color) {
  Frame frame = shoot(shot, scene);
  paint(frame, [&](int, int) { return color; });
  return frame;
}

Frame lit(const std::string& technique, const Frame& frame, const Settings& settings) {
  return run(plan_of(technique, frame, settings, {"indirect_raw"}), frame, device(), {.math = Math::precise}).frame;
}

Color light_at(const Frame& frame, int x, int y) {
  const glm::dvec3 v = vector_at(frame, "indirect_raw", x, y);
  return {float(v.x), float(v.y), float(v.z)};
}

double largest_light(const Frame& frame) {
  double largest = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      for (const float c : light_at(frame, x, y)) largest = std::max(largest, double(c));
    }
  }
  return largest;
}

/// Share of the cosine-weighted directions from a floor in which a wall at right angles, `distance` away, is nearer than the radius:
/// directions within the angle a of the wall's normal, cos a = distance / radius, above the floor.
double share_of_wall(double distance) {
  const double cosine = std::min(distance / radius, 1.0), angle = std::acos(cosine);
  return (angle - std::sin(angle) * cosine) / pi;
}

TEST(Indirect, AnOpenPlaneGetsNoLight) {
  const Frame frame = painted(perspective(80, 60), tilted_plane(4, 0.9, 0.4), {1, 1, 1});
  EXPECT_EQ(largest_light(lit("indirect", frame, {{"radius", "0.8"}})), 0);
}

TEST(Indirect, AWallLightsAFloorByItsFormFactor) {
  // Walls that meet at depth 4 and lean by 45 degrees: the point y below the line is y sqrt(2) from it.
  const Shot shot = orthographic(144, 108, 4);
  Frame frame = shoot(shot, corner());
  paint(frame, [&](int, int y) { return y < 54 ? Color{0.5f, 1, 2} : Color{0, 0, 0}; });
  const Frame light = lit("indirect", frame, limit);
  double squares = 0, worst = 0;
  int count = 0;
  for (int y = 55; y < 80; ++y, ++count) {
    const double below = (y + 0.5 - 54) * 4 / 144, expected = share_of_wall(below * std::sqrt(2.0));
    double mean = 0;
    for (int x = 36; x < 108; ++x) {
      const Color found = light_at(light, x, y);
      ASSERT_NEAR(found[0], found[1] / 2, 1e-5) << y;
      ASSERT_NEAR(found[2], found[1] * 2, 1e-5) << y;
      mean += found[1] / 72;
      // The wall itself sees a black floor.
      ASSERT_EQ(light_at(light, x, 107 - y)[1], 0) << y;
    }
    squares += (mean - expected) * (mean - expected);
    worst = std::max(worst, std::abs(mean - expected));
  }
  std::printf("wall over floor: RMSE %.4f, worst %.4f\n", std::sqrt(squares / count), worst);
  EXPECT_LT(std::sqrt(squares / count), 0.005);
  EXPECT_LT(worst, 0.01);
}

TEST(Indirect, WhiteSurfacesSendWhatTheyClose) {
  for (const Shot& shot : {perspective(144, 108), orthographic(144, 108, 4)}) {
    const Frame frame = painted(shot, corner(), {1, 1, 1});
    const Frame both =
        run(plan_of("indirect", frame, limit, {"indirect_raw", "ao_raw"}), frame, device(), {.math = Math::precise})
            .frame;
    double sum = 0, squares = 0;
    int count = 0;
    for (int y = 20; y < 88; ++y) {
      for (int x = 20; x < 124; ++x, ++count) {
        const double off = light_at(both, x, y)[0] - (1 - raw_at(both, x, y));
        sum += off;
        squares += off * off;
      }
    }
    std::printf("white corner: mean %.5f, RMS %.4f\n", sum / count, std::sqrt(squares / count));
    EXPECT_LT(std::abs(sum / count), 5e-4);
    EXPECT_LT(std::sqrt(squares / count), 0.012);
  }
}

// One slice and two rays a pixel, over many seeds: every elevation comes with every slice. With steps of the rays that are twice those of
// the slices, as they once were, the mean of any number of seeds reads .047 in place of .019.
TEST(Indirect, SeedsAverageToWhatManyDirectionsFind) {
  Frame frame = shoot(orthographic(96, 72, 4), corner());
  paint(frame, [&](int x, int y) {
    const float c = (x / 8 + y / 8) % 2 ? 2.0f : 0.0f;
    return Color{c, c, c};
  });
  const Frame many =
      lit("indirect", frame,
          {{"radius", "0.8"}, {"directions", "64"}, {"steps", "9"}, {"rays", "4"}, {"thickness", "100"}});
  const Plan one =
      plan_of("indirect", frame, {{"radius", "0.8"}, {"directions", "1"}, {"steps", "9"}, {"thickness", "100"}},
              {"indirect_raw"});
  constexpr int seeds = 128;
  std::vector<double> mean(96 * 72, 0);
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame light = run(one, frame, device(), {.math = Math::precise, .seed = seed}).frame;
    for (int y = 0; y < 72; ++y)
      for (int x = 0; x < 96; ++x) mean[size_t(y * 96 + x)] += light_at(light, x, y)[0] / double(seeds);
  }
  double squares = 0;
  int count = 0;
  for (int y = 12; y < 60; ++y) {
    for (int x = 12; x < 84; ++x, ++count) squares += std::pow(mean[size_t(y * 96 + x)] - light_at(many, x, y)[0], 2);
  }
  std::printf("mean of seeds: RMS %.4f\n", std::sqrt(squares / count));
  EXPECT_LT(std::sqrt(squares / count), 0.025);
}

TEST(Indirect, BacksSendNothing) {
  // The board's front faces the eye: to the wall behind the board it shows its back.
  const Frame frame = painted(orthographic(80, 60, 4), step(0.3), {1, 1, 1});
  EXPECT_EQ(largest_light(lit("indirect", frame, {{"radius", "0.8"}})), 0);
  EXPECT_GT(largest_occlusion(raw_of("bitmask", frame, {{"radius", "0.8"}})), 0.1);
}

TEST(Indirect, AmbientOcclusionBesideItIsThatOfBitmask) {
  const Frame frame = painted(perspective(80, 60), room(), {1, 0.5f, 0.25f});
  for (const char* preset : {"low", "medium", "ultra"}) {
    const PlanRequest request{.preset = preset};
    const auto result_of = [&](const std::string& technique, std::vector<std::string> with) {
      PlanRequest own = request;
      own.outputs = {technique};
      own.with = std::move(with);
      return run(make_plan(own, plane_names(frame), "this frame"), frame, device()).frame;
    };
    const Frame light = result_of("indirect", {"ao", "ao_raw", "bent_normal"}),
                ao = result_of("bitmask", {"bent_normal"});
    for (const char* plane : {"ao", "ao_raw", "bent_normal"}) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x)
          ASSERT_EQ(value_at(light, plane, x, y), value_at(ao, plane, x, y)) << preset << plane << x << "," << y;
      }
    }
  }
}

TEST(Indirect, LightIsLinearAndNeverInfinite) {
  const Shot shot = perspective(80, 60);
  const Settings settings = {{"radius", "0.8"}};
  const Frame one = lit("indirect", painted(shot, room(), {1, 0.5f, 3}), settings),
              large = lit("indirect", painted(shot, room(), {1024, 512, 3072}), settings);
  ASSERT_GT(largest_light(one), 0.5);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Frame odd = lit("indirect", painted(shot, room(), {nan, -1, infinity}), settings);
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      for (size_t i = 0; i < 3; ++i) ASSERT_EQ(light_at(large, x, y)[i], 1024 * light_at(one, x, y)[i]);
      ASSERT_EQ(light_at(odd, x, y)[0], 0);
      ASSERT_EQ(light_at(odd, x, y)[1], 0);
      ASSERT_TRUE(std::isfinite(light_at(odd, x, y)[2]));
    }
  }
}

/// The corner whose upper wall lies behind a board near the eye, out of reach: peeled layers show it.
Frame hidden_wall(const Shot& shot) {
  Frame frame = painted(shot, corner(), {1, 0.5f, 0.25f});
  View& view = frame.views[0];
  const Layout layout(shot.width, shot.height);
  const auto layer = [&](const std::string& stack, int number) -> Channel& {
    return plane_of(view, layout, layer_name(stack, number)).channels[0];
  };
  const std::string color[] = {"peel_color_r", "peel_color_g", "peel_color_b"},
                    normal[] = {"peel_normal_x", "peel_normal_y", "peel_normal_z"};
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const int own = y < shot.height / 2 ? 1 : 0;  // the layer that holds the corner
      for (int number = 0; number < 2; ++number) {
        const bool is_wall = number == own;
        layer("peel", number).at(x, y) = is_wall       ? view.find("depth")->channels[0].at(x, y)
                                         : number == 0 ? 0.5f
                                                       : std::numeric_limits<float>::infinity();
        for (size_t i = 0; i < 3; ++i) {
          layer(color[i], number).at(x, y) = is_wall ? view.find("color")->channels[i].at(x, y) : 0;
          layer(normal[i], number).at(x, y) = is_wall ? view.find("normal")->channels[i].at(x, y) : i == 2 ? 1.0f : 0;
        }
      }
    }
  }
  return frame;
}

TEST(Indirect, HiddenLayersSendTheirOwnLight) {
  const Shot shot = perspective(80, 60);
  Frame frame = hidden_wall(shot);
  const Frame seen = lit("indirect", frame, {{"radius", "0.8"}});
  const Frame hidden = lit("dp-indirect", frame, {{"radius", "0.8"}});
  double most = 0;
  for (int y = 31; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      for (size_t i = 0; i < 3; ++i) {
        ASSERT_NEAR(light_at(hidden, x, y)[i], light_at(seen, x, y)[i], 1e-6) << x << "," << y;
        most = std::max(most, double(light_at(seen, x, y)[i]));
      }
    }
  }
  EXPECT_GT(most, 0.2);
}

TEST(Indirect, FewerLayersOfLightThanOfDepthAreDark) {
  Frame frame = hidden_wall(perspective(80, 60));
  frame.views[0].planes.erase("peel_normal_z.01");
  const Frame light = lit("dp-indirect", frame, {{"radius", "0.8"}});
  for (int y = 31; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) ASSERT_EQ(light_at(light, x, y)[0], 0);
  }
}

}  // namespace
}  // namespace gloam::test::indirect_test
