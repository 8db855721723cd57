// Frames with depth layers, and what techniques over layers have in common.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test {

/// A layer's depth at a pixel whose visible depth is `depth`.
using Layer = std::function<float(int x, int y, float depth)>;

float same_depth(int x, int y, float depth);
float nothing(int x, int y, float depth);
/// Every pixel's surface in one of `count` layers, without order.
std::vector<Layer> spread_over(int count);

/// The frame with these layers as its stack `peel`.
Frame with_layers(const Frame& frame, const std::vector<Layer>& layers);

/// What several scenes show together, over layers: one scene each, or front to back.
enum class LayerOrder { by_scene, by_depth };
Frame peeled(const Shot& shot, const std::vector<Scene>& scenes, LayerOrder order);

/// Both kinds of mathematics at each of these lane widths.
std::vector<RunOptions> at_lanes(const std::vector<int>& lanes);

/// Where layers say what the depth says: the same bits from dp-`technique` over them as from `technique` over the depth.
void expect_bits_of_depth(const std::string& technique, const std::string& what, const Frame& frame,
                          const std::vector<Layer>& layers, const Settings& settings,
                          const std::vector<RunOptions>& options);

}  // namespace gloam::test
