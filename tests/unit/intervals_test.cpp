// Intervals of medians: closed forms, and simulated rounds whose median is known.
#include "measure/intervals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace gloam::test::intervals_test {
namespace {

using namespace gloam::bench;
using Rounds = std::vector<double>;

double normal(Random& random) {
  const double u = random.uniform(0x1p-53, 1), angle = random.uniform(0, 6.283185307179586);
  return std::sqrt(-2 * std::log(u)) * std::cos(angle);
}

/// Rounds of median 1 with tails as on a busy machine; `memory`: correlation of one round's noise with the one before.
Rounds simulated(Random& random, size_t n, double memory) {
  constexpr int warm_up = 50;
  Rounds rounds;
  double noise = 0;
  for (size_t i = 0; i < n + warm_up; ++i) {
    noise = memory * noise + std::sqrt(1 - memory * memory) * normal(random);
    if (i >= warm_up) rounds.push_back(std::exp(0.02 * std::sinh(noise)));
  }
  return rounds;
}

/// How many of the intervals of simulated rounds hold the true median, of those that exist.
struct Coverage {
  double held = 0, without = 0;
};
Coverage coverage_of(size_t n, double memory) {
  constexpr int tries = 4000;
  Random random(34, n);
  int held = 0, without = 0;
  for (int i = 0; i < tries; ++i) {
    const std::optional<Interval> interval = interval_of_median(simulated(random, n, memory));
    if (!interval)
      ++without;
    else
      held += interval->low <= 1 && 1 <= interval->high;
  }
  return {double(held) / (tries - without), double(without) / tries};
}

TEST(IntervalOfMedian, EndsAtTheRanksOfTheSignTest) {
  // Of nine rounds the second and the eighth bound the median with 1 - 2 (1 + 9) / 512; the order does not correlate.
  const Rounds rounds = {5, 1, 7, 3, 8, 2, 9, 4, 6};
  ASSERT_EQ(correlation_time(rounds), 1);
  const std::optional<Interval> interval = interval_of_median(rounds, 1 - 20.0 / 512);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 2, 1e-9);
  EXPECT_NEAR(interval->high, 8, 1e-9);
}

TEST(IntervalOfMedian, LiesBetweenTwoRanksForAConfidenceBetweenTheirs) {
  // Ranks 2 and 3 of nine have 492/512 and 420/512. At 95 %: share 0.0778 of the way in confidence; 7 x share / (2 + 5 x share).
  const std::optional<Interval> interval = interval_of_median({5, 1, 7, 3, 8, 2, 9, 4, 6});
  ASSERT_TRUE(interval);
  const double share = (492.0 / 512 - 0.95) / (72.0 / 512);
  EXPECT_NEAR(interval->low, 2 + 7 * share / (2 + 5 * share), 1e-9);
  EXPECT_NEAR(interval->low + interval->high, 10, 1e-9);
}

TEST(IntervalOfMedian, IsThereFromSixRoundsOn) {
  EXPECT_FALSE(interval_of_median({}));
  EXPECT_FALSE(interval_of_median({3}));
  EXPECT_FALSE(interval_of_median({4, 1, 5, 2, 3}));
  EXPECT_TRUE(interval_of_median({4, 1, 6, 2, 5, 3}));
}

TEST(IntervalOfMedian, OfEqualRoundsIsAPoint) {
  const std::optional<Interval> interval = interval_of_median(Rounds(8, 2.5));
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->low, 2.5);
  EXPECT_EQ(interval->high, 2.5);
}

TEST(IntervalOfMedian, DoesNotDependOnHowFarAnOutlierIs) {
  EXPECT_EQ(interval_of_median({5, 1, 7, 3, 8, 2, 9, 4, 6})->high,
            interval_of_median({5, 1, 7, 3, 8, 2, 900, 4, 6})->high);
}

TEST(IntervalOfMedian, HoldsTheMedianOfIndependentRoundsAsOftenAsItSays) {
  for (const size_t n : {6, 9, 15, 40}) {
    const Coverage coverage = coverage_of(n, 0);
    EXPECT_GT(coverage.held, 0.94) << n;
    EXPECT_LT(coverage.held, 0.98) << n;
    EXPECT_LT(coverage.without, n == 6 ? 0.25 : 0.03) << n;
  }
}

TEST(IntervalOfMedian, HoldsTheMedianOfCorrelatedRoundsNearlyAsOften) {
  // The ranks of the sign test alone hold it in 89 and 74 of 100.
  EXPECT_GT(coverage_of(9, 0.3).held, 0.89);
  EXPECT_GT(coverage_of(40, 0.3).held, 0.92);
  EXPECT_GT(coverage_of(40, 0.6).held, 0.87);
}

TEST(CorrelationTime, IsThatOfTheProcess) {
  // (1 + r) / (1 - r) for noise that remembers r; the weights take some of it away.
  Random random(7);
  double independent = 0, correlated = 0;
  constexpr int tries = 200;
  for (int i = 0; i < tries; ++i) {
    independent += correlation_time(simulated(random, 400, 0)) / tries;
    correlated += correlation_time(simulated(random, 400, 0.6)) / tries;
  }
  EXPECT_NEAR(independent, 1.2, 0.15);
  EXPECT_NEAR(correlated, 3.5, 0.5);
}

TEST(CorrelationTime, OfADriftIsLong) {
  Rounds rounds;
  for (int i = 0; i < 16; ++i) rounds.push_back(1 + 0.01 * i);
  EXPECT_GT(correlation_time(rounds), 3);
}

TEST(RatiosOfRounds, AreTakenRoundByRound) { EXPECT_EQ(ratios_of_rounds({2, 6, 9}, {1, 2}), (Rounds{2, 3})); }

TEST(IsNarrowEnough, ComparesHalfTheWidthWithTheMedian) {
  const Rounds rounds = {105, 101, 107, 103, 108, 102, 109, 104, 106};
  const std::optional<Interval> interval = interval_of_median(rounds);
  const double half = (interval->high - interval->low) / 2 / 105;
  EXPECT_NEAR(*relative_half_width(rounds), half, 1e-12);
  EXPECT_TRUE(is_narrow_enough(rounds, half + 1e-6));
  EXPECT_FALSE(is_narrow_enough(rounds, half - 1e-6));
  EXPECT_FALSE(is_narrow_enough({1, 1, 1}, 1));
}

}  // namespace
}  // namespace gloam::test::intervals_test
