// The counts of the roofline, against arithmetic by hand.
#include "measure/roofline.h"

#include <gtest/gtest.h>

namespace gloam::bench::roofline_test {
namespace {

double loads(const char* technique, const char* preset, const char* pass) {
  const std::optional<PassCount> count = count_of(technique, preset, pass);
  EXPECT_TRUE(count) << technique << " " << preset << " " << pass;
  return count ? count->loads : 0;
}

/// HBAO+ reads its pixel's depth and normal, and one value for each of directions x steps samples, unless the pixel is background:
/// the same share of the pixels at each preset, which is 1239 of 1296 at 48x27.
TEST(OperationCounts, AreTheSamplesOfHbaoPlus) {
  const double low = (loads("hbao+", "low", "hbao+/estimate") - 4) / (4 * 4);
  const double medium = (loads("hbao+", "medium", "hbao+/estimate") - 4) / (8 * 4);
  EXPECT_NEAR(medium, 1239. / 1296, 0.02);
  EXPECT_NEAR(low, medium, 0.005);
}

/// The bilateral filter stores one float, and reads all that it needs as floats.
TEST(OperationCounts, AreInBytesOfFloats) {
  const std::optional<PassCount> count = count_of("hbao+", "medium", "bilateral/separable");
  ASSERT_TRUE(count);
  EXPECT_NEAR(count->bytes_stored, 4, 1e-9);
  EXPECT_NEAR(count->bytes_loaded, 4 * count->loads, 0.05);
  EXPECT_GT(count->operations, count->loads);
  EXPECT_GT(count->instructions, count->operations / 2 + count->loads) << "a product with its sum is one";
}

TEST(OperationCounts, AreMissingForWhatWasNotCounted) {
  EXPECT_FALSE(count_of("hbao+", "none", "hbao+/estimate"));
  EXPECT_FALSE(count_of("no technique", "medium", "x"));
  EXPECT_FALSE(count_of("hbao+", "medium", "no pass"));
}

}  // namespace
}  // namespace gloam::bench::roofline_test
