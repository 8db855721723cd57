// The exponent of growth, and the frames for measuring it.
#include "measure/growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gloam/planes.h"

namespace gloam::test::growth_test {
namespace {

using namespace gloam::bench;

std::vector<GrowthPoint> power_law(double factor, double power, const std::vector<double>& xs) {
  std::vector<GrowthPoint> points;
  for (const double x : xs) points.push_back({x, factor * std::pow(x, power)});
  return points;
}

TEST(Growth, ExponentOfAPowerLaw) {
  EXPECT_NEAR(exponent(power_law(1, 1.7, {1, 2, 3, 10, 100})).value(), 1.7, 1e-12);
  EXPECT_NEAR(exponent(power_law(3e-5, 1.7, {129600, 259200, 518400, 2073600})).value(), 1.7, 1e-9);
  EXPECT_NEAR(exponent(power_law(2, 0, {1, 2, 4})).value(), 0, 1e-12);
  EXPECT_NEAR(exponent(power_law(2, -1, {4, 1})).value(), -1, 1e-12);
}

TEST(Growth, ExponentIsTheLeastSquaresFit) {
  // In log2 the points are (0, 0), (1, 1), (2, 4): the line of least squares has slope 2.
  EXPECT_NEAR(exponent({{1, 1}, {2, 2}, {4, 16}}).value(), 2, 1e-12);
}

TEST(Growth, ExponentNeedsTwoDifferentPoints) {
  EXPECT_FALSE(exponent({}));
  EXPECT_FALSE(exponent({{1, 1}}));
  EXPECT_FALSE(exponent({{2, 1}, {2, 3}}));
  EXPECT_FALSE(exponent({{0, 1}, {2, 3}}));
  EXPECT_FALSE(exponent({{1, 0}, {2, 3}}));
  EXPECT_TRUE(exponent({{1, 1}, {2, 3}}));
}

/// Depth = 1 + x + 100 y, two peeled layers of it and two stochastic depths, seen by a camera whose centre is off the middle.
Frame ramp(int width, int height) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  View& view = frame.views.emplace_back();
  view.camera = Camera{.fx = 10, .fy = 20, .cx = 3, .cy = 2};
  for (const std::string& name : {std::string("depth"), layer_name("peel", 0), layer_name("peel", 1),
                                  layer_name("stochastic", 0), layer_name("stochastic", 1)}) {
    Plane plane{name, {}};
    Channel& channel = plane.channels.emplace_back(Layout(width, height), plane_kind(name).outside);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) channel.at(x, y) = float(1 + x + 100 * y);
    }
    view.planes.emplace(name, std::move(plane));
  }
  return frame;
}

TEST(Growth, ResizedFramesShowTheSame) {
  const Frame frame = ramp(8, 6), twice = resized(frame, 16, 12), half = resized(frame, 4, 3);
  EXPECT_EQ(twice.width(), 16);
  EXPECT_EQ(twice.height(), 12);
  const Channel& depth = twice.views[0].planes.at("depth").channels[0];
  EXPECT_EQ(depth.at(0, 0), 1);
  EXPECT_EQ(depth.at(1, 1), 1);
  EXPECT_EQ(depth.at(15, 11), 1 + 7 + 500);
  EXPECT_EQ(twice.views[0].camera->fx, 20);
  EXPECT_EQ(twice.views[0].camera->fy, 40);
  EXPECT_EQ(twice.views[0].camera->cx, 6);
  EXPECT_EQ(half.views[0].planes.at("depth").channels[0].at(3, 2), 1 + 7 + 500);
  EXPECT_EQ(half.views[0].camera->cy, 1);
}

TEST(Growth, FewerLayersAndMoreViews) {
  const Frame frame = ramp(8, 6);
  EXPECT_TRUE(with_layers(frame, 1).views[0].find("peel.00"));
  EXPECT_FALSE(with_layers(frame, 1).views[0].find("peel.01"));
  EXPECT_TRUE(with_layers(frame, 1).views[0].find("depth"));
  EXPECT_TRUE(with_layers(frame, 1).views[0].find("stochastic.01"));
  const Frame four = with_views(frame, 4);
  ASSERT_EQ(four.views.size(), 4u);
  EXPECT_EQ(four.views[3].planes.at("depth").channels[0].at(5, 5), 506);
}

}  // namespace
}  // namespace gloam::test::growth_test
