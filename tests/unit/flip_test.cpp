// FLIP on computed images, against a transcription of the authors' Python code (github.com/NVlabs/flip).
#include "compare/flip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam::test::flip_test {
namespace {

using Colour = cv::Vec3d;

template <typename Pattern>
cv::Mat image_of(int width, int height, Pattern pattern) {
  cv::Mat image(height, width, CV_64FC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at<Colour>(y, x) = pattern(double(x), double(y));
  }
  return image;
}

cv::Mat plain(const Colour& colour) {
  return image_of(8, 8, [&](double, double) { return colour; });
}

cv::Mat waves() {
  return image_of(56, 40, [](double x, double y) {
    return Colour(0.5 + 0.4 * std::sin(0.3 * x), 0.5 + 0.4 * std::cos(0.2 * y), x > y ? 0.8 : 0.2);
  });
}

cv::Mat other_waves() {
  return image_of(56, 40, [](double x, double y) {
    return Colour(0.5 + 0.4 * std::sin(0.3 * x + 0.4), 0.45 + 0.4 * std::cos(0.2 * y), x > y + 2 ? 0.7 : 0.2);
  });
}

double mean(const cv::Mat& map) { return cv::mean(map)[0]; }

TEST(Flip, GreenAndBlueAreFarthestFromEachOther) {
  EXPECT_NEAR(mean(flip_map(plain({0, 1, 0}), plain({0, 0, 1}))), 1, 1e-8);
  EXPECT_EQ(mean(flip_map(plain({0.2, 0.7, 0.4}), plain({0.2, 0.7, 0.4}))), 0);
}

TEST(Flip, PlainImagesAsTheAuthorsHaveThem) {
  EXPECT_NEAR(mean(flip_map(plain({0, 0, 0}), plain({1, 1, 1}))), 0.9673797627205596, 1e-7);
  EXPECT_NEAR(mean(flip_map(plain({0.25, 0.25, 0.25}), plain({0.5, 0.5, 0.5}))), 0.4518496411120435, 1e-7);
}

TEST(Flip, EdgesAndColoursAsTheAuthorsHaveThem) {
  const cv::Mat map = flip_map(other_waves(), waves());
  EXPECT_NEAR(mean(map), 0.3003879421932732, 1e-7);
  EXPECT_NEAR(map.at<double>(0, 0), 0.41445160063075004, 1e-7);
  EXPECT_NEAR(map.at<double>(20, 20), 0.338511218671118, 1e-7);
  EXPECT_NEAR(map.at<double>(20, 23), 0.3410054928772424, 1e-7);
  EXPECT_NEAR(map.at<double>(39, 55), 0.27685444137428716, 1e-7);
}

TEST(Flip, IsTheSameBothWays) {
  EXPECT_NEAR(mean(flip_map(other_waves(), waves())), mean(flip_map(waves(), other_waves())), 1e-12);
}

TEST(Flip, DependsOnNothingOutOfReach) {
  EXPECT_EQ(flip_reach(), 10);
  cv::Mat changed = waves();
  changed.at<Colour>(20, 40) = {0, 0, 0};
  const cv::Mat map = flip_map(changed, waves());
  EXPECT_GT(map.at<double>(20, 40), 0.05);
  for (int x = 0; x < 40 - flip_reach(); ++x) EXPECT_NEAR(map.at<double>(20, x), 0, 1e-7) << x;
}

TEST(Flip, WhatScreensCannotShowIsCutOff) {
  EXPECT_EQ(mean(flip_map(plain({3, 2, 5}), plain({1, 1, 1}))), 0);
  EXPECT_EQ(mean(flip_map(plain({-1, 0, 0}), plain({0, 0, 0}))), 0);
}

}  // namespace
}  // namespace gloam::test::flip_test
