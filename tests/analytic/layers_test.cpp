// Common properties of every technique over depth layers (dp-X) and X: if the layers hold the same as the depth, both have the
// same bits, and an occluder that the depth hides counts. A technique is included by being in the registry.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/depth_layers.h"
#include "support/estimate.h"
#include "support/long.h"
#include "support/stress.h"

namespace gloam::test::layers_test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

/// The methods whose variants over peeled layers estimate the same ambient occlusion from layers as from a depth: not those that are
/// fitted to each. What layers send besides is indirect_test.cpp's.
std::vector<std::string> techniques_with_layers() {
  std::vector<std::string> names;
  for (const Technique& technique : registry()) {
    if (technique.variant.layers != Layers::peeled) continue;
    const bool is_fitted = ParameterValues(technique.parameters).has("coefficients");
    const std::vector<std::string>& made = technique.writes;
    if (!is_fitted && std::find(made.begin(), made.end(), "ao_raw") != made.end()) names.push_back(technique.variant.of);
  }
  return names;
}

class DepthLayers : public testing::TestWithParam<std::string> {
 protected:
  bool has(const std::string& parameter) const {
    const std::vector<Parameter>& all = find_technique(GetParam()).parameters;
    return std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == parameter; });
  }

  /// Settings with which far and near samples of low hills count, for each weighting.
  std::vector<Settings> variants() const {
    std::vector<Settings> all = {{{"radius", "0.5"}}, {{"radius", "3"}}};
    if (has("weighting") && is_long_run()) all.push_back({{"weighting", "cosine"}, {"bias", "0.01"}});
    return all;
  }
};

INSTANTIATE_TEST_SUITE_P(All, DepthLayers, testing::ValuesIn(techniques_with_layers()),
                         [](const auto& info) { return identifier(info.param); });

TEST_P(DepthLayers, ThatSayWhatTheDepthSays) {
  const Layer even = [](int x, int y, float depth) { return (x + y) % 2 == 0 ? depth : inf; };
  const Layer odd = [](int x, int y, float depth) { return (x + y) % 2 != 0 ? depth : inf; };
  const std::vector<std::pair<const char*, std::vector<Layer>>> all = {
      {"the depth", {same_depth}},
      {"the depth twice", {same_depth, nothing, same_depth}},
      {"the depth at last", {nothing, nothing, same_depth}},
      {"every other pixel", {odd, even, nothing}}};
  for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4)}) {
    // All techniques share the code that reads cameras and layers.
    if (shot.camera.orthographic && GetParam() != "hbao" && !is_long_run()) continue;
    const Frame frame = shoot(shot, room());
    for (const auto& [what, layers] : all) {
      for (const Settings& settings : variants())
        expect_bits_of_depth(GetParam(), what, frame, layers, settings, at_lanes(usual_lanes(device())));
    }
  }
}

/// A sign near the eye hides a block on the wall. The sign is beyond the radius, so the depth alone shows the wall beside
/// the block open; the layers show what the depth would without the sign.
TEST_P(DepthLayers, ShowAHiddenOccluder) {
  const Shot shot = perspective(93, 61);
  const Scene sign = within(tilted_plane(1, 0, 0), 0.1, 0.13), block = within(tilted_plane(3.6, 0, 0), 0.3, 0.4),
              wall = tilted_plane(4, 0, 0);
  // Right of the sign, 0.15 from the block's edge, at half its height.
  const int x = int(shot.camera.cx + 0.115 * shot.camera.fx), y = int(shot.camera.cy);
  const Frame hidden = shoot(shot, nearest_of({sign, block, wall})), shown = shoot(shot, nearest_of({block, wall}));
  ASSERT_NEAR(value_at(hidden, "depth", x, y), 4, 1e-6);
  Settings settings = {{"radius", "0.7"}};
  if (has("samples")) settings.emplace_back("samples", "200");
  for (const RunOptions& options : at_lanes(usual_lanes(device()))) {
    EXPECT_EQ(raw_at(raw_of(GetParam(), hidden, settings, options), x, y), 1);
    const float expected = raw_at(raw_of(GetParam(), shown, settings, options), x, y);
    EXPECT_LT(expected, 0.95);
    for (const LayerOrder order : {LayerOrder::by_scene, LayerOrder::by_depth}) {
      const Frame layered = peeled(shot, {sign, block, wall}, order);
      EXPECT_NEAR(raw_at(raw_of("dp-" + GetParam(), layered, settings, options), x, y), expected, 1e-6)
          << "lanes " << options.lanes;
    }
    if (!has("range")) continue;
    const Frame unlimited = raw_of(GetParam(), hidden, joined(settings, {{"range", "inf"}}), options);
    EXPECT_LT(raw_at(unlimited, x, y), 0.97) << "the sign takes nothing away";
  }
}

}  // namespace
}  // namespace gloam::test::layers_test
