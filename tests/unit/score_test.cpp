// gloam score: names of images, best fits, FLIP of greys.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/flip.h"
#include "compare/grey_flip.h"
#include "score/fit.h"
#include "score/submitted_files.h"

namespace gloam::test::score_test {
namespace {

std::vector<score::Target> targets_for_names() {
  score::Target hall, hall_two, walk, pair;
  hall.name = "hall";
  hall_two.name = "hall_2";
  walk.name = "walk";
  walk.is_sequence = true;
  pair.name = "pair";
  pair.views = {"left", "right"};
  return {hall, hall_two, walk, pair};
}

TEST(ScoreNames, SayItemFrameViewAndEffect) {
  const auto parse = [](const std::string& stem) {
    const auto named = score::parse_image_name(stem, targets_for_names(), "ao");
    return named ? fmt::format("{} {} '{}' {}", named->item, named->frame, named->view, named->effect) : "none";
  };
  EXPECT_EQ(parse("hall"), "hall 0 '' ao");
  EXPECT_EQ(parse("hall_specular_occlusion"), "hall 0 '' specular_occlusion");
  EXPECT_EQ(parse("hall_2"), "hall_2 0 '' ao");
  EXPECT_EQ(parse("hall_2_indirect"), "hall_2 0 '' indirect");
  EXPECT_EQ(parse("walk.0012"), "walk 12 '' ao");
  EXPECT_EQ(parse("walk.12_ao"), "walk 12 '' ao");
  EXPECT_EQ(parse("walk_ao.0012"), "walk 12 '' ao");
  EXPECT_EQ(parse("walk_ao.x"), "none");
  EXPECT_EQ(parse("pair_left"), "pair 0 'left' ao");
  EXPECT_EQ(parse("pair_right_indirect"), "pair 0 'right' indirect");
  EXPECT_EQ(parse("pair_middle"), "none");
  EXPECT_EQ(parse("hallway"), "none");
  EXPECT_EQ(parse("walk.99999999999"), "none");
  EXPECT_EQ(parse("nave"), "none");
}

bench::Image image_of_values(const std::vector<float>& values) {
  bench::Image image;
  Plane& plane = image[""] = Plane{"ao", {}};
  Channel& channel = plane.channels.emplace_back(Layout(int(values.size()), 1), 1);
  for (size_t i = 0; i < values.size(); ++i) channel.at(int(i), 0) = values[i];
  return image;
}

/// Values made from a truth with the inverse of a known exponent and strength are fitted by these.
TEST(ScoreFit, FindsTheExponentAndTheStrength) {
  std::mt19937 random(3);
  std::vector<float> truth, test;
  for (int i = 0; i < 5000; ++i) {
    const double made = double(random() % 10001) / 10000;
    test.push_back(float(made));
    truth.push_back(float(1 - 0.7 * (1 - std::pow(made, 1.6))));
  }
  const bench::Foreground all = {{"", Mask(truth.size(), 1)}};
  score::FitSums sums(true);
  sums.add(image_of_values(test), image_of_values(truth), all);
  const auto best = sums.best();
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->exponent, 1.6, 1e-3);  // bins of 1/4096
  EXPECT_NEAR(best->strength, 0.7, 1e-4);
  EXPECT_LT(best->rmse, 1e-4);
  EXPECT_NEAR(*sums.correlation(), 0.99, 0.02);
  const bench::Image made = score::fitted(image_of_values(test), *best, true);
  EXPECT_LT(bench::rmse(made, image_of_values(truth), all), 1e-4);
}

/// No other exponent and strength leave less, on values without any law.
TEST(ScoreFit, IsTheLeastOfItsNeighbours) {
  std::mt19937 random(4);
  std::vector<float> truth, test;
  for (int i = 0; i < 3000; ++i) {
    test.push_back(float(random() % 256) / 255);
    truth.push_back(float(random() % 1000) / 1000 * 0.5f + 0.5f * test.back());
  }
  const bench::Foreground all = {{"", Mask(truth.size(), 1)}};
  score::FitSums sums(true);
  sums.add(image_of_values(test), image_of_values(truth), all);
  const score::BestFit best = *sums.best();
  const auto rmse = [&](double exponent, double strength) {
    double sum = 0;
    for (size_t i = 0; i < test.size(); ++i)
      sum += std::pow(1 - strength * (1 - std::pow(double(test[i]), exponent)) - double(truth[i]), 2);
    return std::sqrt(sum / double(test.size()));
  };
  EXPECT_NEAR(rmse(best.exponent, best.strength), best.rmse, 1e-9);
  for (const double factor : {0.97, 1.03}) {
    EXPECT_GT(rmse(best.exponent * factor, best.strength), best.rmse);
    EXPECT_GT(rmse(best.exponent, best.strength * factor), best.rmse);
  }
}

TEST(ScoreFit, HasNothingToFitWhereNothingIsSaid) {
  score::FitSums none(true), open(true), black(false);
  EXPECT_FALSE(none.best());
  open.add(image_of_values({1, 1, 1}), image_of_values({0.5f, 1, 0}), {{"", Mask(3, 1)}});
  EXPECT_FALSE(open.best());
  EXPECT_FALSE(open.correlation());
  black.add(image_of_values({0, 0}), image_of_values({1, 2}), {{"", Mask(2, 1)}});
  EXPECT_FALSE(black.best());
}

/// The short cut for greys is FLIP of the same greys as colours.
TEST(GreyFlip, IsFlipOfThreeEqualChannels) {
  constexpr int width = 70, height = 150;
  cv::Mat a(height, width, CV_32F), b(height, width, CV_32F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      a.at<float>(y, x) = float(0.5 + 0.5 * std::sin(0.3 * x) * std::cos(0.11 * y));
      b.at<float>(y, x) = float(x > y ? 0.8 : 0.5 + 0.4 * std::sin(0.29 * x));
    }
  }
  const auto colours = [](const cv::Mat& grey) {
    cv::Mat wide, out;
    grey.convertTo(wide, CV_64F);
    cv::merge(std::vector<cv::Mat>{wide, wide, wide}, out);
    return out;
  };
  const cv::Mat grey = grey_flip_map(a, b), colour = flip_map(colours(a), colours(b));
  EXPECT_GT(cv::mean(colour)[0], 0.1);
  double most = 0;
  cv::minMaxLoc(cv::abs(grey - colour), nullptr, &most);
  EXPECT_LT(most, 2e-4);  // floats, of which a power near 0 makes more
  EXPECT_NEAR(cv::mean(grey)[0], cv::mean(colour)[0], 1e-5);
}

}  // namespace
}  // namespace gloam::test::score_test
