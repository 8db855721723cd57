// The choice of effects for a time or an error (host/auto/choice.h).
#include "auto/choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam::test::choice_test {
namespace {

/// Two effects that change the picture by 3 and by 4, independently: without both it is 5 off.
ChoiceProblem two_effects() {
  ChoiceProblem problem;
  problem.effects = {{{{"ao"}, 2, 0.5, 0.5}, {{"ao"}, 10, 0.1, 0.1}},
                     {{{"reflection"}, 4, 0.25, 0.25}, {{"reflection"}, 20, 0, 0}}};
  problem.loss_without = {3, 4};
  problem.loss_with = [](const std::vector<std::string>& planes) {
    const bool ao = std::find(planes.begin(), planes.end(), "ao") != planes.end();
    const bool reflection = std::find(planes.begin(), planes.end(), "reflection") != planes.end();
    return std::hypot(ao ? 0 : 3, reflection ? 0 : 4);
  };
  return problem;
}

using Options = std::vector<int>;

TEST(Choice, ErrorsOfWhatIsComputedAndOfWhatIsLeftOutAddAsSquares) {
  const ChoiceProblem problem = two_effects();
  EXPECT_DOUBLE_EQ(figures_of(problem, {left_out, left_out}).error, 5);
  EXPECT_DOUBLE_EQ(figures_of(problem, {0, left_out}).error, std::hypot(1.5, 4));
  EXPECT_DOUBLE_EQ(figures_of(problem, {0, 0}).error, std::hypot(1.5, 1));
  EXPECT_DOUBLE_EQ(figures_of(problem, {0, 0}).ms, 6);
}

TEST(Choice, TheLeastErrorWithinATime) {
  const ChoiceProblem problem = two_effects();
  EXPECT_EQ(best_within(problem, {.ms = 0})->options, (Options{left_out, left_out}));
  EXPECT_EQ(best_within(problem, {.ms = 2})->options, (Options{0, left_out}));
  // The second effect changes more than the first.
  EXPECT_EQ(best_within(problem, {.ms = 4})->options, (Options{left_out, 0}));
  EXPECT_EQ(best_within(problem, {.ms = 6})->options, (Options{0, 0}));
  EXPECT_EQ(best_within(problem, {.ms = 14})->options, (Options{1, 0}));
  EXPECT_EQ(best_within(problem, {.ms = 1000})->options, (Options{1, 1}));
  EXPECT_EQ(nearest_miss(problem, {.error = 0}).options, (Options{1, 1}));
  EXPECT_FALSE(best_within(problem, {.ms = -1}));
}

TEST(Choice, TheLeastTimeWithinAnError) {
  const ChoiceProblem problem = two_effects();
  EXPECT_EQ(best_within(problem, {.error = 5})->options, (Options{left_out, left_out}));
  EXPECT_EQ(best_within(problem, {.error = 2})->options, (Options{0, 0}));
  EXPECT_EQ(best_within(problem, {.error = 1.6})->options, (Options{1, 0}));
  EXPECT_EQ(best_within(problem, {.error = 0.31})->options, (Options{1, 1}));
  EXPECT_FALSE(best_within(problem, {.error = 0.29}));
}

TEST(Choice, OfEqualErrorsTheFaster) {
  ChoiceProblem problem = two_effects();
  problem.effects[0] = {{{"ao"}, 9, 0.5, 0.5}, {{"ao"}, 2, 0.5, 0.5}};
  EXPECT_EQ(best_within(problem, {.ms = 100})->options[0], 1);
}

// Leaving both out has nearly the least error, since one darkens what the other brightens.
TEST(Choice, LuckDecidesNothing) {
  ChoiceProblem problem;
  problem.effects = {{{{"ao"}, 1, 0.5, 0}}, {{{"indirect"}, 1, 0.5, 0}}};
  problem.loss_without = {1, 1};
  for (const double of_none : {0.98, 0.9}) {
    problem.loss_with = [=](const std::vector<std::string>& planes) {
      return planes.empty() ? of_none : planes.size() == 2 ? 1.0 : 2.0;
    };
    const Choice best = *best_within(problem, {.ms = 10});
    EXPECT_EQ(best.options, of_none == 0.98 ? (Options{0, 0}) : (Options{left_out, left_out})) << of_none;
  }
  EXPECT_DOUBLE_EQ(figures_of(problem, {0, left_out}).without_luck, std::sqrt(1.25));
}

TEST(Choice, WithoutEffectsThereIsNothingToChoose) {
  ChoiceProblem problem;
  problem.loss_with = [](const std::vector<std::string>&) { return 0.0; };
  EXPECT_EQ(best_within(problem, {.ms = 0})->error, 0);
}

}  // namespace
}  // namespace gloam::test::choice_test
