#include "support/depth_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/low_discrepancy.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "support/estimate.h"
#include "support/stress.h"

namespace gloam::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

float depth_in_layer(const Shot& shot, const std::vector<Scene>& scenes, LayerOrder order, size_t layer, int x, int y) {
  std::vector<float> depths;
  for (const Scene& scene : scenes) depths.push_back(depth_at(shot, scene, x, y));
  if (order == LayerOrder::by_depth) std::sort(depths.begin(), depths.end());
  return depths[layer];
}

}  // namespace

float same_depth(int, int, float depth) { return depth; }
float nothing(int, int, float) { return inf; }

std::vector<Layer> spread_over(int count) {
  std::vector<Layer> layers;
  for (int k = 0; k < count; ++k) {
    layers.push_back([=](int x, int y, float depth) {
      return hash(uint32_t(x) + 4099u * uint32_t(y)) % uint32_t(count) == uint32_t(k) ? depth : inf;
    });
  }
  return layers;
}

Frame with_layers(const Frame& frame, const std::vector<Layer>& layers) {
  Frame copy = clone(frame);
  for (size_t k = 0; k < layers.size(); ++k) {
    Channel& layer = plane_of(copy, layer_name("peel", int(k))).channels[0];
    for (int y = 0; y < copy.height(); ++y) {
      for (int x = 0; x < copy.width(); ++x) layer.at(x, y) = layers[k](x, y, value_at(copy, "depth", x, y));
    }
  }
  normalise(copy);
  return copy;
}

Frame peeled(const Shot& shot, const std::vector<Scene>& scenes, LayerOrder order) {
  std::vector<Layer> layers;
  for (size_t k = 0; k < scenes.size(); ++k)
    layers.push_back([&, k](int x, int y, float) { return depth_in_layer(shot, scenes, order, k, x, y); });
  return with_layers(shoot(shot, nearest_of(scenes)), layers);
}

std::vector<RunOptions> at_lanes(const std::vector<int>& lanes) {
  std::vector<RunOptions> all;
  for (const int width : lanes) {
    for (const Math math : {Math::precise, Math::fast}) all.push_back({.math = math, .lanes = width});
  }
  return all;
}

void expect_bits_of_depth(const std::string& technique, const std::string& what, const Frame& frame,
                          const std::vector<Layer>& layers, const Settings& settings,
                          const std::vector<RunOptions>& options) {
  const Frame layered = with_layers(frame, layers);
  for (const RunOptions& option : options) {
    EXPECT_TRUE(
        same_bits(raw_of("dp-" + technique, layered, settings, option), raw_of(technique, frame, settings, option)))
        << technique << ", " << what << ", lanes " << option.lanes
        << (option.math == Math::fast ? ", fast" : ", precise");
  }
}

}  // namespace gloam::test
