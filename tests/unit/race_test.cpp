// The split of a technique's time.
#include "measure/race.h"

#include <gtest/gtest.h>

namespace gloam::test::race_test {
namespace {

using namespace gloam::bench;

TEST(SplitEstimate, IsGathersAndTheRest) {
  const std::vector<Share> shares = split_estimate(8, 0.25);
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].what, "gathers");
  EXPECT_EQ(shares[0].share, 2);
  EXPECT_EQ(shares[1].what, "arithmetic of the estimate");
  EXPECT_EQ(shares[1].share, 6);
}

TEST(SplitEstimate, SplitsNothingWhereGathersAloneTakeLonger) {
  const std::vector<Share> shares = split_estimate(8, 1.25);
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_EQ(shares[0].what, "estimate, whose gathers alone take longer");
  EXPECT_EQ(shares[0].share, 8);
}

}  // namespace
}  // namespace gloam::test::race_test
