// HBAO+ over all peeled layers against HBAO+ over one depth: where the layers say what the depth says, both are the same
// to the bit; what a layer adds is told from closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "low_discrepancy.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

/// A layer's depth at a pixel whose visible depth is `depth`.
using Layer = std::function<float(int x, int y, float depth)>;

float same_depth(int, int, float depth) { return depth; }
float nothing(int, int, float) { return inf; }

Frame with_layers(const Frame& frame, const std::vector<Layer>& layers) {
  Frame copy = clone(frame);
  for (size_t k = 0; k < layers.size(); ++k) {
    Channel& layer = plane_of(copy, layer_name("peel", int(k))).channels[0];
    const Channel& depth = plane_of(copy, "depth").channels[0];
    for (int y = 0; y < copy.height(); ++y) {
      for (int x = 0; x < copy.width(); ++x) layer.at(x, y) = layers[k](x, y, depth.at(x, y));
    }
  }
  normalise(copy);
  return copy;
}

Frame raw_of(const std::string& technique, const Frame& frame, const RunOptions& options,
             const Settings& settings = {}) {
  PlanRequest request{.outputs = {technique}, .only = {"ao_raw"}, .then = "none", .settings = settings};
  return run(make_plan(request, plane_names(frame), "this frame"), frame, device(), options).frame;
}

float raw_at(const Frame& result, int x, int y) { return result.views[0].find("ao_raw")->channels[0].at(x, y); }

std::vector<RunOptions> all_widths() {
  std::vector<RunOptions> all;
  for (const int lanes : {1, 4, 8, 16}) {
    for (const Math math : {Math::precise, Math::fast}) all.push_back({.math = math, .lanes = lanes});
  }
  return all;
}

/// The same bits as HBAO+ on the depth, at all lane widths and for a radius that leaves the image too.
void expect_hbao_plus(const char* what, const Frame& frame, const std::vector<Layer>& layers) {
  const Frame layered = with_layers(frame, layers);
  for (const char* radius : {"0.5", "3"}) {
    for (const RunOptions& options : all_widths()) {
      const Frame expected = raw_of("hbao+", frame, options, {{"radius", radius}});
      EXPECT_TRUE(same_bits(raw_of("dp-hbao+", layered, options, {{"radius", radius}}), expected))
          << what << ", radius " << radius << ", lanes " << options.lanes
          << (options.math == Math::fast ? ", fast" : ", precise");
    }
  }
}

std::vector<Frame> frames() {
  std::vector<Frame> all;
  all.push_back(shoot(perspective(93, 61), room()));
  all.push_back(shoot(orthographic(93, 61, 4), room()));
  return all;
}

TEST(DpHbaoPlus, OneLayerThatIsTheDepth) {
  for (const Frame& frame : frames()) expect_hbao_plus("one layer", frame, {same_depth});
  // Rows of more than 32767 floats take another way to their samples.
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

/// Every pixel's surface stands in one layer of many, without order: all layers are read, and each at its place.
TEST(DpHbaoPlus, SurfacesSpreadOverTheLayers) {
  for (const int count : {1, 2, 8, 64}) {
    std::vector<Layer> layers;
    for (int k = 0; k < count; ++k) {
      layers.push_back([=](int x, int y, float depth) {
        return hash(uint32_t(x) + 4099u * uint32_t(y)) % uint32_t(count) == uint32_t(k) ? depth : inf;
      });
    }
    for (const Frame& frame : frames()) expect_hbao_plus("spread", frame, layers);
  }
}

/// Layers that both occlude: at each sample the larger contribution counts, so their order is of no matter, and together
/// they take away more than either and less than the sum.
TEST(DpHbaoPlus, TheLargestContributionCounts) {
  const Layer nearer = [](int x, int, float depth) { return x % 3 == 0 ? inf : 0.97f * depth; };
  const Layer further = [](int, int y, float depth) { return y % 3 == 0 ? inf : 0.9f * depth; };
  for (const Frame& frame : frames()) {
    for (const RunOptions& options : all_widths()) {
      const Frame both = raw_of("dp-hbao+", with_layers(frame, {nearer, further}), options);
      EXPECT_TRUE(same_bits(raw_of("dp-hbao+", with_layers(frame, {further, nearer}), options), both));
      const Frame one = raw_of("dp-hbao+", with_layers(frame, {nearer}), options);
      const Frame other = raw_of("dp-hbao+", with_layers(frame, {further}), options);
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

/// All surfaces of several scenes under each pixel, front to back.
Frame peeled(const Shot& shot, const std::vector<Scene>& scenes) {
  const Scene visible = [&](const EyeRay& ray) {
    std::optional<Surface> nearest;
    for (const Scene& scene : scenes) {
      const auto seen = scene(ray);
      if (seen && (!nearest || seen->depth < nearest->depth)) nearest = seen;
    }
    return nearest;
  };
  std::vector<Layer> layers;
  for (size_t k = 0; k < scenes.size(); ++k) {
    layers.push_back([&, k](int x, int y, float) {
      std::vector<float> depths;
      for (const Scene& scene : scenes) {
        const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
        depths.push_back(seen ? float(seen->depth) : inf);
      }
      std::sort(depths.begin(), depths.end());
      return depths[k];
    });
  }
  return with_layers(shoot(shot, visible), layers);
}

/// A sign near the eye hides a block on the wall: the depth alone shows the wall beside it open.
TEST(DpHbaoPlus, AHiddenOccluderDarkens) {
  const Shot shot = perspective(160, 120);
  const Scene sign = within(tilted_plane(1, 0, 0), 0.1, 0.13), block = within(tilted_plane(3.6, 0, 0), 0.3, 0.4),
              wall = tilted_plane(4, 0, 0);
  const Frame frame = peeled(shot, {sign, block, wall});
  // Right of the sign, 0.16 from the block's edge, at half its height.
  const int x = int(shot.camera.cx + 0.115 * shot.camera.fx), y = int(shot.camera.cy);
  ASSERT_NEAR(plane_of(const_cast<Frame&>(frame), "depth").channels[0].at(x, y), 4, 1e-6);
  for (const RunOptions& options : all_widths()) {
    const Settings settings = {{"radius", "0.8"}};
    const float hidden = raw_at(raw_of("hbao+", frame, options, settings), x, y);
    const float shown = raw_at(raw_of("dp-hbao+", frame, options, settings), x, y);
    EXPECT_EQ(hidden, 1) << "lanes " << options.lanes;
    // Without the sign the depth shows the block.
    const float expected = raw_at(raw_of("hbao+", peeled(shot, {block, wall}), options, settings), x, y);
    EXPECT_LT(expected, 0.99);
    EXPECT_NEAR(shown, expected, 1e-6) << "lanes " << options.lanes;
  }
}

}  // namespace
}  // namespace gloam::test
