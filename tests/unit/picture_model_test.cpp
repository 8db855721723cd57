// Expected errors of a picture (host/planner/picture_model.h).
#include "planner/picture_model.h"

#include <gtest/gtest.h>

namespace gloam::test::picture_model_test {
namespace {

bool all_go(const std::vector<std::string>&) { return true; }

/// A look that sees ambient occlusion and a reflection.
SeenChanges seen(double kept_when_coarser) {
  return {.names = {"ao", "reflection", hidden_light},
          .products = {{4, 0, -1}, {0, 9, 0}, {-1, 0, 1}},
          .kept_when_coarser = {{"ao", kept_when_coarser}, {"reflection", kept_when_coarser}, {hidden_light, 1}}};
}

TEST(PictureModel, TheSquareOfADifference) {
  const PictureModel model = {.planes = {"ao", "indirect"},
                              .products = {{4, -1}, {-1, 2}},
                              .with_truth = {3, 1},
                              .uncertainty = {0.5, 0.25},
                              .truth = 5};
  EXPECT_DOUBLE_EQ(expected_square(model, {}).square, 5);
  EXPECT_DOUBLE_EQ(expected_square(model, {{"ao"}}).square, 5 + 4 - 6);
  EXPECT_DOUBLE_EQ(expected_square(model, {{"ao", 0.5, 0.25}}).square, 5 + 4 * (0.25 + 0.25) - 3);
  EXPECT_DOUBLE_EQ(expected_square(model, {{"ao"}, {"indirect"}}).square, 5 + 4 + 2 - 2 - 6 - 2);
  EXPECT_DOUBLE_EQ(expected_square(model, {{"ao"}}).deviation, 1);
  EXPECT_DOUBLE_EQ(expected_square(model, {{"contact"}}).square, 5);
  EXPECT_DOUBLE_EQ(mean_square_change(model, {{"ao"}, {"indirect"}}), 4);
}

// Where light of what stands in the way is plenty, ambient occlusion is worth less.
TEST(PictureModel, HiddenLightTakesFromWhatOcclusionIsWorth) {
  SeenChanges much = seen(0.5), none = seen(0.5);
  none.products[0][2] = none.products[2][0] = none.products[2][2] = 0;
  const PictureModel with = model_of(much, all_go), without = model_of(none, all_go);
  ASSERT_EQ(with.planes, (std::vector<std::string>{"ao", "reflection"}));
  EXPECT_LT(with.with_truth[0], without.with_truth[0]);
  EXPECT_EQ(with.products[0][0], without.products[0][0]);
  EXPECT_GT(with.truth, 0);
}

// The frame says what fewer pixels cost: much where neighbours differ.
TEST(PictureModel, FewerPixelsCostMoreWhereThereIsDetail) {
  for (const char* plane : {"ao", "bounces", "indirect", "reflection"}) {
    const SeenChanges smooth = {.names = {plane}, .products = {{1}}, .kept_when_coarser = {{plane, 0.95}}};
    const SeenChanges fine = {.names = {plane}, .products = {{1}}, .kept_when_coarser = {{plane, 0.3}}};
    const UsedPlane full = plane_by(plane, "ultra", 1, fine), half = plane_by(plane, "ultra", 2, fine),
                    quarter = plane_by(plane, "ultra", 4, fine), of_smooth = plane_by(plane, "ultra", 4, smooth);
    EXPECT_GT(full.kept, half.kept) << plane;
    EXPECT_GT(half.kept, quarter.kept) << plane;
    EXPECT_GT(of_smooth.kept, quarter.kept) << plane;
    EXPECT_LE(full.noise, quarter.noise) << plane;
    EXPECT_LT(plane_by(plane, "low", 1, fine).kept, 1) << plane;
  }
}

TEST(PictureModel, WhatNobodyMeasuredIsTakenForWhatItSees) {
  const PictureModel model =
      model_of({.names = {"contact"}, .products = {{2}}, .kept_when_coarser = {{"contact", 0.9}}}, all_go);
  EXPECT_DOUBLE_EQ(model.products[0][0], 2);
  EXPECT_DOUBLE_EQ(model.with_truth[0], 2);
  EXPECT_LE(plane_by("contact", "no such preset", 1, seen(0.9)).kept, 1);
}

}  // namespace
}  // namespace gloam::test::picture_model_test
