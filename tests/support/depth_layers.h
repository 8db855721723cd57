// Frames with depth layers, and a common test of techniques over layers.
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
/// Distributes the pixels' surfaces irregularly over `count` layers.
std::vector<Layer> spread_over(int count);

/// The frame with these layers as its stack `peel`.
Frame with_layers(const Frame& frame, const std::vector<Layer>& layers);

/// Order of the layers of several scenes together: one scene each, or front to back.
enum class LayerOrder { by_scene, by_depth };
Frame peeled(const Shot& shot, const std::vector<Scene>& scenes, LayerOrder order);

/// Both kinds of mathematics at each of these lane widths.
std::vector<RunOptions> at_lanes(const std::vector<int>& lanes);

/// Expects the same bits from dp-`technique` over the layers as from `technique` over the depth.
void expect_bits_of_depth(const std::string& technique, const std::string& what, const Frame& frame,
                          const std::vector<Layer>& layers, const Settings& settings,
                          const std::vector<RunOptions>& options);

}  // namespace gloam::test
