// What gloam auto and gloam pick have in common (host/planner): goals, options, and which of many a goal asks for.
#include <gtest/gtest.h>

#include <algorithm>

#include "gloam/error.h"
#include "planner/figures.h"
#include "planner/goal.h"
#include "planner/plan_option.h"
#include "planner/reason.h"

namespace gloam::test::planner_test {
namespace {

const std::vector<Figures> measured = {{10, 0.2}, {4, 0.5}, {25, 0.1}, {4, 0.4}, {12, 0.2}};

TEST(PlannerFigures, TheMostAccurateWithinATimeAndOfEqualsTheFastest) {
  EXPECT_EQ(best_within(measured, {.ms = 24}), 0u);
  EXPECT_EQ(best_within(measured, {.ms = 25}), 2u);
  EXPECT_EQ(best_within(measured, {.ms = 4}), 3u);
  EXPECT_FALSE(best_within(measured, {.ms = 3.9}));
  EXPECT_EQ(nearest_miss(measured, {.ms = 3.9}), 3u);
}

TEST(PlannerFigures, TheFastestWithinAnErrorAndOfEqualsTheMostAccurate) {
  EXPECT_EQ(best_within(measured, {.error = 1}), 3u);
  EXPECT_EQ(best_within(measured, {.error = 0.2}), 0u);
  EXPECT_FALSE(best_within(measured, {.error = 0.05}));
  EXPECT_EQ(nearest_miss(measured, {.error = 0.05}), 2u);
}

TEST(PlannerFigures, AnExpectedErrorKeepsABoundByItsUncertainty) {
  const std::vector<Figures> expected = {{10, 0.100, 0.05}, {12, 0.102, 0.02}, {14, 0.104, 0.01}};
  EXPECT_EQ(best_within(expected, {.ms = 20}), 0u);
  EXPECT_EQ(best_within(expected, {.error = 0.16}), 0u);
  EXPECT_EQ(best_within(expected, {.error = 0.13}), 1u);
  EXPECT_EQ(best_within(expected, {.error = 0.115}), 2u);
  EXPECT_FALSE(best_within(expected, {.error = 0.105}));
  EXPECT_EQ(nearest_miss(expected, {.error = 0.01}), 0u);
}

TEST(PlannerFigures, ARankingBeginsWithTheBestAndEndsWithTheFarthest) {
  const auto ranked = [](const Goal& goal) {
    std::vector<size_t> order = {0, 1, 2, 3, 4};
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return ranks_before(measured[a], measured[b], goal); });
    return order;
  };
  EXPECT_EQ(ranked({.ms = 10}), (std::vector<size_t>{0, 3, 1, 4, 2}));
  EXPECT_EQ(ranked({.error = 0.4}), (std::vector<size_t>{3, 0, 4, 2, 1}));
}

const OptionWords letters = {.label = [](size_t i) { return std::string(1, char('a' + i)); }};

TEST(PlannerReason, NamesTheChoiceAndTheNextFaster) {
  EXPECT_EQ(why_chosen(measured, 2, {.ms = 30}, letters),
            "the most accurate within 30 ms: c with 25.00 ms and RMSE 0.1000; the next faster, a, takes 10.00 ms and "
            "errs 100 % more");
  EXPECT_EQ(why_chosen(measured, 0, {.error = 0.3}, letters),
            "the fastest within RMSE 0.3: a with 10.00 ms and RMSE 0.2000; the next faster, d, takes 4.00 ms and errs "
            "100 % more");
  EXPECT_EQ(why_chosen(measured, 3, {.ms = 4}, letters),
            "the most accurate within 4 ms: d with 4.00 ms and RMSE 0.4000; nothing faster is known, and the next "
            "best, b, takes "
            "4.00 ms and errs 25 % more");
  EXPECT_EQ(why_chosen({{4, 0.4}}, 0, {.ms = 4}, letters),
            "the most accurate within 4 ms: a with 4.00 ms and RMSE 0.4000; nothing faster is known");
  EXPECT_EQ(
      why_chosen({{1, 0.1}, {5, 0.2}, {20, 0.15}}, 0, {.ms = 10}, letters),
      "the most accurate within 10 ms: a with 1.00 ms and RMSE 0.1000; nothing faster is known, and the next best, "
      "b, takes 5.00 ms and errs 100 % more");
  EXPECT_NE(why_chosen({{2, 1}, {1, 1.034}}, 0, {.ms = 2}, letters).find("errs 3.4 % more"), std::string::npos);
  EXPECT_NE(why_chosen({{2, 0}, {1, 0.5}}, 0, {.ms = 2}, letters).find("has RMSE 0.5000"), std::string::npos);
  EXPECT_NE(why_chosen(measured, 3, {.ms = 1}, letters).find("nothing is within 1 ms, and nearest to it: d"),
            std::string::npos);
}

TEST(PlannerReason, WhereNothingIsWithinTheGoalItNamesTheNearest) {
  EXPECT_EQ(why_none(measured, {.ms = 1}, letters),
            "--budget 1ms: nothing is that fast on this device; the fastest is d with 4.00 ms");
  EXPECT_EQ(why_none(measured, {.error = 0.01}, letters),
            "--error 0.01: nothing comes that near to the truth; the nearest is c with RMSE 0.1000");
}

TEST(PlannerGoal, IsOneOfBoth) {
  EXPECT_EQ(in_words(Goal{.ms = 20}), "--budget 20ms");
  EXPECT_EQ(in_words(Goal{.error = 0.1}), "--error 0.1");
  EXPECT_NO_THROW(check_one_goal({}));
  EXPECT_THROW(check_one_goal({.ms = 1, .error = 1}), UsageError);
  EXPECT_THROW(check_has_goal({}, "pick"), UsageError);
  EXPECT_NO_THROW(check_has_goal({.ms = 1}, "pick"));
}

TEST(PlannerGoal, IsATimeOrFramesPerSecond) {
  EXPECT_DOUBLE_EQ(*time_goal("20ms").ms, 20);
  EXPECT_DOUBLE_EQ(*time_goal("0.02s").ms, 20);
  EXPECT_DOUBLE_EQ(*time_goal("60fps").ms, 1000.0 / 60);
  EXPECT_DOUBLE_EQ(*time_goal("23.976fps").ms, 1000 / 23.976);
  EXPECT_EQ(in_words(time_goal("60fps")), "--budget 60fps (16.67 ms)");
  EXPECT_EQ(bound_in_words(time_goal("60fps"), "RMSE"), "within 16.67 ms, for 60fps");
  for (const char* wrong : {"fps", "0fps", "-60fps", "60 fps", "inffps", "nanfps", "60fps30ms", "60hz", "20", ""})
    EXPECT_THROW(time_goal(wrong), UsageError) << wrong;
}

TEST(PlannerOption, IsNamedByTechniquesPresetAndResolution) {
  EXPECT_EQ((PlanOption{{.outputs = {"evidence", "multi-bounce"}, .preset = "low", .resolution = 2}}.label()),
            "evidence + multi-bounce, low, half");
  EXPECT_EQ((PlanOption{{.outputs = {"ao"}}}.label()), "ao, default, full");
  EXPECT_EQ((PlanOption{{.outputs = {"gtao"}, .preset = "high", .temporal = true}}.setting()), "high, full, temporal");
}

}  // namespace
}  // namespace gloam::test::planner_test
