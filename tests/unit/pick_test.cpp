// The settings that gloam pick times in turn, out of all that it tried once.
#include "bench/pick.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gloam::test {
namespace {

using namespace gloam::bench;

Choice tried(double ms, double rmse) { return {.variation = {}, .ms = ms, .rmse = rmse}; }

TEST(PickFinalists, WithinTheBudgetAreNotCrowdedOutByNearMisses) {
  // Thirty just above the budget, all more accurate than any within it.
  std::vector<Choice> tries;
  for (int i = 0; i < 30; ++i) tries.push_back(tried(11 + 0.1 * i, 0.1 + 0.001 * i));
  for (int i = 0; i < 10; ++i) tries.push_back(tried(9 - 0.1 * i, 0.2 + 0.001 * i));
  const size_t best_within = 30, fastest = tries.size();
  tries.push_back(tried(1, 0.5));
  tries.push_back(tried(16, 0.01));  // far above
  const std::vector<size_t> kept = finalists_of(tries, {.budget = 10});
  EXPECT_EQ(kept, (std::vector<size_t>{fastest, best_within, 31, 32, 33, 34, 35, 0, 1, 2, 3, 4}));
}

TEST(PickFinalists, AreTheMostAccurateWhereFewFit) {
  const std::vector<Choice> tries = {tried(20, 0.1), tried(12, 0.2), tried(9, 0.3), tried(14, 0.15), tried(5, 0.4)};
  EXPECT_EQ(finalists_of(tries, {.budget = 10}), (std::vector<size_t>{4, 2, 3, 1}));
  EXPECT_EQ(finalists_of(tries, {.budget = 1}), (std::vector<size_t>{4}));  // none fits: the nearest miss
}

TEST(PickFinalists, WithinAnErrorAreTheCheapest) {
  std::vector<Choice> tries;
  for (int i = 0; i < 20; ++i) tries.push_back(tried(20 - i, 0.1));
  tries.push_back(tried(0.5, 0.11));  // an error does not change when it is measured again
  tries.push_back(tried(30, 0.05));
  const std::vector<size_t> kept = finalists_of(tries, {.error = 0.1});
  EXPECT_EQ(kept, (std::vector<size_t>{21, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9}));
}

}  // namespace
}  // namespace gloam::test
