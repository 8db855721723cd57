// The choice of effects for a time or an error (host/auto/choice.h).
#include "auto/choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam::test::choice_test {
namespace {

/// Two effects that change the picture by 3 and by 4, independently, and make all of the true change: without both it is 5 off. The faster
/// option of each has noise.
ChoiceProblem two_effects() {
  ChoiceProblem problem;
  problem.model = {.planes = {"ao", "reflection"},
                   .products = {{9, 0}, {0, 16}},
                   .with_truth = {9, 16},
                   .uncertainty = {0, 0},
                   .truth = 25};
  problem.effects = {{{{{"ao", 1, 0.25}}, 2}, {{{"ao", 1, 0.01}}, 10}},
                     {{{{"reflection", 1, 0.0625}}, 4}, {{{"reflection", 1, 0.04}}, 20}}};
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
  EXPECT_EQ(best_within(problem, {.error = 1.1})->options, (Options{1, 0}));
  EXPECT_EQ(best_within(problem, {.error = 0.87})->options, (Options{1, 1}));
  EXPECT_FALSE(best_within(problem, {.error = 0.7}));
}

TEST(Choice, OfEqualErrorsTheFaster) {
  ChoiceProblem problem = two_effects();
  problem.effects[0] = {{{{"ao", 1, 0.25}}, 9}, {{{"ao", 1, 0.25}}, 2}};
  EXPECT_EQ(best_within(problem, {.ms = 100})->options[0], 1);
}

/// Ambient occlusion takes away what light of near surfaces gives back: the truth is hardly different from the colour.
ChoiceProblem two_that_cancel() {
  ChoiceProblem problem;
  problem.model = {.planes = {"ao", "indirect"},
                   .products = {{16, -15}, {-15, 16}},
                   .with_truth = {1, 1},
                   .uncertainty = {2, 2},
                   .truth = 2};
  problem.effects = {{{{{"ao"}}, 5}}, {{{{"indirect"}}, 5}}};
  return problem;
}

TEST(Choice, OneOfTwoThatCancelIsWorseThanNeither) {
  const ChoiceProblem problem = two_that_cancel();
  EXPECT_DOUBLE_EQ(figures_of(problem, {0, left_out}).error, 4);
  EXPECT_EQ(best_within(problem, {.ms = 5})->options, (Options{left_out, left_out}));
  // Both together make the small true change.
  EXPECT_LT(figures_of(problem, {0, 0}).error, 0.5);
  EXPECT_EQ(best_within(problem, {.ms = 10})->options, (Options{0, 0}));
}

TEST(Choice, AnErrorIsPromisedOnlyByItsUncertainty) {
  ChoiceProblem problem = two_effects();
  const double error = figures_of(problem, {1, 0}).error;
  EXPECT_TRUE(best_within(problem, {.error = error}));
  problem.model.uncertainty = {1, 1};
  const Choice unsure = figures_of(problem, {1, 0});
  EXPECT_DOUBLE_EQ(unsure.error, error);
  EXPECT_DOUBLE_EQ(unsure.uncertainty, std::sqrt(8.0) / (2 * error));
  EXPECT_EQ(best_within(problem, {.error = error + unsure.uncertainty})->options, (Options{1, 0}));
  EXPECT_FALSE(best_within(problem, {.error = error}));
}

TEST(Choice, OfPlanesThatThePictureDoesNotUseNothingIsExpected) {
  ChoiceProblem problem = two_effects();
  problem.uses = [](const std::vector<std::string>& made) {
    EXPECT_TRUE(std::is_sorted(made.begin(), made.end()));
    return std::vector<std::string>{"reflection"};
  };
  EXPECT_DOUBLE_EQ(figures_of(problem, {1, 0}).error, figures_of(problem, {left_out, 0}).error);
}

TEST(Choice, WithoutEffectsThereIsNothingToChoose) { EXPECT_EQ(best_within(ChoiceProblem(), {.ms = 0})->error, 0); }

}  // namespace
}  // namespace gloam::test::choice_test
