// Light with bounces: what both fits promise at the ends, the published cubic, and albedo that is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/normalise.h"
#include "support/estimate.h"

namespace gloam::test::multi_bounce_test {
namespace {

constexpr int steps = 65;

/// AO rises from 0 to 1 along rows, albedo down the columns; red, green and blue alike.
Frame ao_and_albedo() {
  Frame frame = shoot(perspective(steps, steps), tilted_plane(3, 0, 0));
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      plane_of(frame, "ao").channels[0].at(x, y) = float(x) / (steps - 1);
      for (Channel& channel : plane_of(frame, "albedo").channels) channel.at(x, y) = float(y) / (steps - 1);
    }
  }
  return frame;
}

Frame bounces_of(const Frame& frame, const std::string& fit) {
  return run(plan_of("multi-bounce", frame, {{"fit", fit}}, {"bounces"}), frame, device(), {.math = Math::precise})
      .frame;
}

class MultiBounce : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Fits, MultiBounce, testing::Values("own", "jimenez"),
                         [](const auto& info) { return info.param; });

TEST_P(MultiBounce, IsAoWithoutAlbedoAndOneWhereAllIsOpen) {
  const Frame frame = ao_and_albedo(), out = bounces_of(frame, GetParam());
  for (int i = 0; i < steps; ++i) {
    EXPECT_EQ(value_at(out, "bounces", steps - 1, i), 1) << "open, albedo " << i;
    EXPECT_EQ(value_at(out, "bounces", 0, i), 0) << "closed, albedo " << i;
  }
  if (GetParam() == "jimenez") return;  // the cubic is above AO even without albedo
  for (int x = 0; x < steps; ++x) EXPECT_EQ(value_at(out, "bounces", x, 0), value_at(frame, "ao", x, 0));
}

TEST_P(MultiBounce, NeverFallsWithAo) {
  const Frame frame = ao_and_albedo(), out = bounces_of(frame, GetParam());
  for (int y = 0; y < steps; ++y) {
    for (int x = 1; x < steps; ++x) {
      EXPECT_GE(value_at(out, "bounces", x, y), value_at(out, "bounces", x - 1, y)) << x << ", " << y;
      EXPECT_GE(value_at(out, "bounces", x, y), value_at(frame, "ao", x, y)) << x << ", " << y;
    }
  }
}

TEST(MultiBounceCubic, IsThatOfThePaper) {
  const Frame frame = ao_and_albedo(), out = bounces_of(frame, "jimenez");
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const double ao = double(x) / (steps - 1), rho = double(y) / (steps - 1);
      const double a = 2.0404 * rho - .3324, b = -4.7951 * rho + .6417, c = 2.7552 * rho + .6903;
      const double expected = std::min(std::max(ao, ((a * ao + b) * ao + c) * ao), 1.0);
      EXPECT_NEAR(value_at(out, "bounces", x, y), expected, 1e-6);
    }
  }
}

TEST_P(MultiBounce, TakesAlbedoThatIsNoneForTheNearestThatIs) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Frame wrong = ao_and_albedo(), right = ao_and_albedo();
  const std::pair<float, float> values[] = {{nan, 0}, {-1, 0}, {-inf, 0}, {7, 1}, {inf, 1}};
  for (int x = 0; x < steps; ++x) {
    for (size_t i = 0; i < 3; ++i) {
      plane_of(wrong, "albedo").channels[i].at(x, 1) = values[size_t(x) % 5].first;
      plane_of(right, "albedo").channels[i].at(x, 1) = values[size_t(x) % 5].second;
    }
  }
  // The kernel's own clamp, and that of loading.
  EXPECT_TRUE(same_bits(bounces_of(wrong, GetParam()), bounces_of(right, GetParam())));
  normalise(wrong);
  EXPECT_TRUE(same_bits(bounces_of(wrong, GetParam()), bounces_of(right, GetParam())));
}

}  // namespace
}  // namespace gloam::test::multi_bounce_test
