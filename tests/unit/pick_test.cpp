// How gloam pick finds the best setting: what is tried, timed again and left out. Times are made up, and so is the clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "measure/contest.h"

namespace gloam::test::pick_test {
namespace {

using namespace gloam::bench;

bench::Choice tried(double ms, double rmse) { return {.variation = {}, .ms = ms, .rmse = rmse}; }

TEST(PickFinalists, WithinTheBudgetAreNotCrowdedOutByNearMisses) {
  // Thirty just above the budget, all more accurate than any within it.
  std::vector<bench::Choice> tries;
  for (int i = 0; i < 30; ++i) tries.push_back(tried(11 + 0.1 * i, 0.1 + 0.001 * i));
  for (int i = 0; i < 10; ++i) tries.push_back(tried(9 - 0.1 * i, 0.2 + 0.001 * i));
  const size_t best_within = 30, fastest = tries.size();
  tries.push_back(tried(1, 0.5));
  tries.push_back(tried(16, 0.01));  // far above
  const std::vector<size_t> kept = finalists_of(tries, {.goal = {.ms = 10}});
  EXPECT_EQ(kept, (std::vector<size_t>{fastest, best_within, 31, 32, 33, 34, 35, 0, 1, 2, 3, 4}));
}

TEST(PickFinalists, AreTheMostAccurateWhereFewFit) {
  const std::vector<bench::Choice> tries = {tried(20, 0.1), tried(12, 0.2), tried(9, 0.3), tried(14, 0.15),
                                            tried(5, 0.4)};
  EXPECT_EQ(finalists_of(tries, {.goal = {.ms = 10}}), (std::vector<size_t>{4, 2, 3, 1}));
  EXPECT_EQ(finalists_of(tries, {.goal = {.ms = 1}}), (std::vector<size_t>{4}));  // none fits: the nearest miss
}

TEST(PickFinalists, WithinAnErrorAreTheCheapest) {
  std::vector<bench::Choice> tries;
  for (int i = 0; i < 20; ++i) tries.push_back(tried(20 - i, 0.1));
  tries.push_back(tried(0.5, 0.11));  // an error does not change when it is measured again
  tries.push_back(tried(30, 0.05));
  const std::vector<size_t> kept = finalists_of(tries, {.goal = {.error = 0.1}});
  EXPECT_EQ(kept, (std::vector<size_t>{21, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9}));
}

/// Settings with made-up errors and times, on a clock that goes on by what they take.
class PickContest : public testing::Test {
 protected:
  struct Made {
    double ms, rmse;
    int slow_readings = 0;  ///< the first ones take ten times as long
  };

  /// Presets of a technique at full resolution.
  void add(const std::string& technique, const std::vector<Made>& presets) {
    const Technique& found = find_technique(technique);
    for (size_t i = 0; i < presets.size(); ++i) {
      settings_.push_back({.technique = &found, .preset = found.presets.at(i).name});
      made_.push_back(presets[i]);
    }
  }

  ContestResult hold(PickOptions options, double seconds, double compiling = 0) {
    seconds_ = 0;
    readings_.clear();
    if (seconds > 0) options.limit = TimeLimit(seconds, [this] { return seconds_; });
    const auto time = [this](size_t i) {
      const double ms = made_[i].ms * (readings_[i]++ < made_[i].slow_readings ? 10 : 1);
      seconds_ += 1e-3 * ms;
      return ms;
    };
    const auto attempt = [&](size_t i) -> std::optional<bench::Choice> {
      seconds_ += compiling;
      return Choice{.variation = settings_[i], .ms = time(i), .rmse = made_[i].rmse};
    };
    return hold_contest(settings_, options, {attempt, time});
  }

  static std::string best_of(const ContestResult& result) {
    return result.best ? option_of(result.finalists[*result.best].choice.variation).label() : "none";
  }

  std::vector<Variation> settings_;
  std::vector<Made> made_;
  std::map<size_t, int> readings_;
  double seconds_ = 0;
};

TEST_F(PickContest, OneSlowReadingCostsNothing) {
  add("gtao", {{4, 0.3}, {8, 0.2, 2}, {30, 0.1}, {60, 0.05}});
  add("hbao", {{2, 0.5}, {5, 0.4}, {9, 0.35}, {20, 0.3}});
  for (const double seconds : {0.0, 60.0}) {
    EXPECT_EQ(best_of(hold({.goal = {.ms = 10}}, seconds)), "gtao, medium, full") << seconds;
    EXPECT_EQ(best_of(hold({.goal = {.error = 0.2}}, seconds)), "gtao, medium, full") << seconds;
  }
}

TEST_F(PickContest, OneSlowReadingLeavesNoHigherPresetOut) {
  add("gtao", {{2, 0.3, 1}, {4, 0.2}, {8, 0.1}, {60, 0.05}});
  add("hbao", {{2, 0.5}, {5, 0.4}, {9, 0.35}, {20, 0.3}});
  const ContestResult result = hold({.goal = {.ms = 10}}, 60);
  EXPECT_EQ(best_of(result), "gtao, high, full");
  for (const Skipped& left_out : result.left_out) EXPECT_NE(left_out.technique, "gtao") << left_out.why;
  EXPECT_EQ(best_of(hold({.goal = {.error = 0.1}}, 60)), "gtao, high, full");
}

TEST_F(PickContest, WhatIsTooSlowByAllItsReadingsRulesHigherPresetsOut) {
  add("gtao", {{40, 0.3}, {80, 0.2}, {160, 0.1}, {320, 0.05}});
  add("hbao", {{2, 0.5}, {5, 0.4}, {9, 0.35}, {20, 0.3}});
  const ContestResult result = hold({.goal = {.ms = 10}}, 60);
  EXPECT_EQ(best_of(result), "hbao, high, full");
  EXPECT_EQ(result.finalists.size() + result.others.size(), result.tried);
  ASSERT_EQ(result.left_out.size(), 3u);
  for (const Skipped& left_out : result.left_out) EXPECT_EQ(left_out.why, "gtao, low, full takes 40 ms already");
  EXPECT_EQ(readings_.at(0), int(enough_readings));
}

TEST_F(PickContest, KeepsWhatWasTriedAndIsNoFinalist) {
  add("gtao", {{40, 0.3}, {80, 0.2}, {160, 0.1}, {320, 0.05}});
  const ContestResult result = hold({.goal = {.error = 0.2}}, 0);
  EXPECT_EQ(best_of(result), "gtao, medium, full");
  ASSERT_EQ(result.others.size(), 1u);  // it is faster, and errs more than is allowed
  EXPECT_EQ(option_of(result.others[0].choice.variation).label(), "gtao, low, full");
}

TEST_F(PickContest, TheTimeIsNotExceeded) {
  for (const char* technique : {"gtao", "hbao", "hbao+", "bitmask", "evidence", "ssao", "alchemy", "sao"})
    add(technique, {{200, 0.3}, {400, 0.2}, {800, 0.15}, {1600, 0.1}});
  for (const double compiling : {0.1, 1.0, 3.0}) {
    for (const double seconds : {10.0, 20.0, 60.0}) {
      for (const PickOptions& options : {PickOptions{.goal = {.ms = 500}}, PickOptions{.goal = {.ms = 5000}},
                                         PickOptions{.goal = {.error = 0.25}}}) {
        const ContestResult result = hold(options, seconds, compiling);
        EXPECT_LE(seconds_, seconds) << compiling;
        if (seconds == 60) {
          EXPECT_TRUE(result.best) << compiling;
        }
        EXPECT_GE(result.tried + result.left_out.size(), settings_.size());
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test::pick_test
