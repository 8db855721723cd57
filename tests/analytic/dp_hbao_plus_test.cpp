// HBAO+ over all peeled layers against HBAO+ over one depth, at all lane widths: if the layers hold the same as the depth, both
// have the same bits; the effect of another layer is known in closed form. Common properties of techniques over layers are in
// layers_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/depth_layers.h"
#include "support/estimate.h"
#include "support/long.h"

namespace gloam::test::dp_hbao_plus_test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

std::vector<RunOptions> all_widths() { return at_lanes({1, 4, 8, 16}); }

/// For a radius that leaves the image too.
void expect_hbao_plus(const std::string& what, const Frame& frame, const std::vector<Layer>& layers) {
  for (const char* radius : {"0.5", "3"}) {
    expect_bits_of_depth("hbao+", what + ", radius " + radius, frame, layers, {{"radius", radius}}, all_widths());
  }
}

std::vector<Frame> frames() {
  std::vector<Frame> all;
  all.push_back(shoot(perspective(93, 61), room()));
  all.push_back(shoot(orthographic(93, 61, 4), room()));
  return all;
}

/// Rows of more than 32767 floats take another code path to their samples.
TEST(DpHbaoPlus, OneLayerOfAWideFrame) {
  expect_hbao_plus("wide frame", shoot(perspective(32800, 3), tilted_plane(2, 1.2, 0.3)), {same_depth});
}

TEST(DpHbaoPlus, EmptyLayersChangeNothing) {
  for (const Frame& frame : frames()) {
    expect_hbao_plus("empty layer behind", frame, {same_depth, nothing});
    expect_hbao_plus("empty layers around", frame, {nothing, nothing, same_depth, nothing});
  }
}

TEST(DpHbaoPlus, LayersThatRepeatChangeNothing) {
  for (const Frame& frame : frames()) expect_hbao_plus("twice", frame, {same_depth, same_depth});
}

/// All layers are read, each at its position. One layer is the depth itself.
TEST(DpHbaoPlus, SurfacesSpreadOverTheLayers) {
  for (const int count : {1, 2, 8, 64}) {
    if (count > 8 && !is_long_run()) continue;  // a loop over more takes half a minute to compile
    for (const Frame& frame : frames()) expect_hbao_plus("spread", frame, spread_over(count));
  }
}

/// Layers that both occlude: the larger contribution counts at each sample, so their order does not matter, and together they
/// take more than either and less than the sum.
TEST(DpHbaoPlus, TheLargestContributionCounts) {
  const Layer nearer = [](int x, int, float depth) { return x % 3 == 0 ? inf : 0.97f * depth; };
  const Layer further = [](int, int y, float depth) { return y % 3 == 0 ? inf : 0.9f * depth; };
  for (const Frame& frame : frames()) {
    for (const RunOptions& options : all_widths()) {
      const Frame both = raw_of("dp-hbao+", with_layers(frame, {nearer, further}), {}, options);
      EXPECT_TRUE(same_bits(raw_of("dp-hbao+", with_layers(frame, {further, nearer}), {}, options), both));
      const Frame one = raw_of("dp-hbao+", with_layers(frame, {nearer}), {}, options);
      const Frame other = raw_of("dp-hbao+", with_layers(frame, {further}), {}, options);
      int more = 0, less_than_sum = 0;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const float a = 1 - raw_at(one, x, y), b = 1 - raw_at(other, x, y), together = 1 - raw_at(both, x, y);
          EXPECT_GE(together, std::max(a, b) - 1e-6f) << x << ", " << y;
          EXPECT_LE(together, a + b + 1e-6f) << x << ", " << y;
          more += together > std::max(a, b) + 1e-3f;
          less_than_sum += together < a + b - 1e-3f;
        }
      }
      EXPECT_GT(more, frame.width() * frame.height() / 10) << "the layers add nothing to each other";
      EXPECT_GT(less_than_sum, frame.width() * frame.height() / 10) << "the layers never meet";
    }
  }
}

}  // namespace
}  // namespace gloam::test::dp_hbao_plus_test
