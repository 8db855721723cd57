// Techniques over stochastic depth lie between the same over one depth and over all layers, on built-in scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gloam/planes.h"
#include "gloam/scene/capture.h"
#include "support/estimate.h"
#include "support/long.h"

namespace gloam::test {
namespace {

/// From the first camera, with all layers that can be stored.
Frame captured(const std::string& name) {
  const gloam::Scene scene = load_scene(name, {});
  CaptureOptions options{.width = 480, .height = 270, .planes = {"depth", "normal"}, .peel = 32};
  options.views = {{"", camera_for(scene.cameras.front(), options.width, options.height), {}}};
  return capture(Tracer(scene), options).frame;
}

Channel unfiltered(const Frame& frame, const std::string& technique, const Settings& settings, double radius) {
  const Frame result =
      raw_of(technique, frame, joined(settings, {{"radius", std::to_string(radius)}}), {.math = Math::precise});
  return result.views[0].planes.at("ao_raw").channels[0].clone();
}

double rmse(const Frame& frame, const Channel& a, const Channel& b) {
  const Channel& depth = frame.views[0].planes.at("depth").channels[0];
  double sum = 0, count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (is_background(depth.at(x, y))) continue;
      const double off = double(a.at(x, y)) - b.at(x, y);
      sum += off * off;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

const Settings directions_of_the_paper = {{"directions", "8"}, {"steps", "4"}};

class StochasticDepthOn : public testing::TestWithParam<std::string> {};

TEST_P(StochasticDepthOn, ClosesTheGapToAllLayers) {
  ONLY_IN_LONG_RUN();
  const double radius = load_scene(GetParam(), {}).ao_radius;
  const Frame frame = captured(GetParam());
  const auto image = [&](const std::string& technique, const Settings& settings) {
    return unfiltered(frame, technique, joined(directions_of_the_paper, settings), radius);
  };
  const Channel all_layers = image("dp-hbao", {});
  const double gap = rmse(frame, image("hbao", {}), all_layers);
  std::printf("%s: hbao to dp-hbao %.4f; closed", GetParam().c_str(), gap);
  std::map<int, double> closed;
  double before = gap;
  for (const int samples : {1, 2, 4, 8, 16}) {
    const double left = rmse(frame, image("sd-hbao", {{"samples", std::to_string(samples)}}), all_layers);
    EXPECT_LT(left, before) << samples << " samples";
    before = left;
    closed[samples] = 1 - left / gap;
    std::printf(" %.0f %% (%d)", 100 * closed[samples], samples);
  }
  const double compensated =
      1 - rmse(frame, image("sd-hbao", {{"samples", "4"}, {"compensation", "1.3"}}), all_layers) / gap;
  std::printf("; 4 with compensation 1.3: %.0f %%\n", 100 * compensated);
  EXPECT_GE(closed[4], 0.5);
  EXPECT_GE(closed[8], 0.65);
  EXPECT_GT(compensated, closed[4]);
}

/// The effect of the paper's early-out, and of the default one: next to nothing.
TEST_P(StochasticDepthOn, EarlyOutCostsLittle) {
  ONLY_IN_LONG_RUN();
  const double radius = load_scene(GetParam(), {}).ao_radius;
  const Frame frame = captured(GetParam());
  for (const char* technique : {"ssao", "hbao", "hbao+", "gtao", "bitmask"}) {
    const std::string sd = std::string("sd-") + technique;
    const auto image = [&](const std::string& name, const Settings& settings) {
      return unfiltered(frame, name, settings, radius);
    };
    const Channel all_layers = image(std::string("dp-") + technique, {});
    const double gap = rmse(frame, image(technique, {}), all_layers);
    std::map<std::string, double> left;
    for (const char* early_out : {"off", "below", "on"})
      left[early_out] = rmse(frame, image(sd, {{"samples", "8"}, {"early_out", early_out}}), all_layers);
    std::printf("%s, %s: gap %.4f; left with early-out off %.4f, below %.4f, on %.4f\n", GetParam().c_str(), sd.c_str(),
                gap, left["off"], left["below"], left["on"]);
    EXPECT_LT(left["below"], gap) << sd;
    EXPECT_LT(left["on"], gap) << sd;
    EXPECT_LE(left["below"], left["off"] + 0.05 * gap) << sd;
  }
}

/// Only background in the map: the same bits as without a map.
TEST(StochasticDepth, EmptySamplesChangeNothing) {
  Frame frame = shoot(perspective(96, 64), room());
  for (const char* technique : {"ssao", "hbao", "hbao+", "gtao", "bitmask"}) {
    Frame with_map = clone(frame);
    for (int i = 0; i < 4; ++i) plane_of(with_map, layer_name("stochastic", i));
    const Channel without = unfiltered(frame, technique, {}, 0.5),
                  with = unfiltered(with_map, std::string("sd-") + technique, {}, 0.5);
    EXPECT_EQ(rmse(frame, without, with), 0) << technique;
  }
}

INSTANTIATE_TEST_SUITE_P(All, StochasticDepthOn, testing::Values("colonnade", "corridor"));

}  // namespace
}  // namespace gloam::test
