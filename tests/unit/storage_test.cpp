// The effect of half precision on planes.
#include "measure/storage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam::test::storage_test {
namespace {

using namespace gloam::bench;

TEST(Storage, HalfIsTheNearest) {
  EXPECT_EQ(as_half(0), 0);
  EXPECT_EQ(as_half(1), 1);
  EXPECT_EQ(as_half(-0.333251953125f), -0.333251953125f);  // -0x1.554p-2 is one
  EXPECT_EQ(as_half(1 + 0x1p-12f), 1);
  EXPECT_EQ(as_half(1 + 3 * 0x1p-12f), 1 + 0x1p-10f);
  EXPECT_EQ(as_half(0x1p-24f), 0x1p-24f);             // the smallest
  EXPECT_EQ(as_half(0x1p-15f + 0x1p-26f), 0x1p-15f);  // fewer digits below 2^-14
  EXPECT_EQ(as_half(0x1p-15f + 3 * 0x1p-26f), 0x1p-15f + 0x1p-24f);
  EXPECT_EQ(as_half(1e6f), 65504);
  EXPECT_TRUE(std::isinf(as_half(INFINITY)));
  EXPECT_TRUE(std::isnan(as_half(NAN)));
}

TEST(Storage, DepthsAreRoundedInRelationToTheirMedian) {
  Frame frame;
  frame.display = frame.window = {0, 0, 32, 24};
  View& view = frame.views.emplace_back();
  const Layout layout(32, 24);
  for (const char* name : {"depth", "normal", "color"}) {
    Plane& plane = view.planes.emplace(name, Plane{name, {}}).first->second;
    plane.channels.emplace_back(layout, 0.1f);
  }
  Channel& depth = view.planes.at("depth").channels[0];
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) depth.at(x, y) = 1e9f * (1 + 0.001f * float(x + 32 * y));  // no half holds that
  }
  depth.at(3, 3) = INFINITY;
  const Frame rounded = stored_in_half(frame);
  const Channel& result = rounded.views[0].planes.at("depth").channels[0];
  int changed = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      if (x == 3 && y == 3) continue;
      EXPECT_NEAR(result.at(x, y) / depth.at(x, y), 1, 0x1p-11f);
      changed += result.at(x, y) != depth.at(x, y);
    }
  }
  EXPECT_GT(changed, 700);
  EXPECT_TRUE(std::isinf(result.at(3, 3)));
  EXPECT_EQ(rounded.views[0].planes.at("normal").channels[0].at(0, 0), as_half(0.1f));
  EXPECT_EQ(rounded.views[0].planes.at("color").channels[0].at(0, 0), 0.1f);  // no technique stores it
}

}  // namespace
}  // namespace gloam::test::storage_test
