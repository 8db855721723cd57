#include "gloam/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/core/ocl.hpp>
#include <opencv2/quality/qualitygmsd.hpp>
#include <opencv2/quality/qualityssim.hpp>
#include <random>

#include "compare/flip.h"
#include "gloam/error.h"

namespace gloam::metrics_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

using Pattern = std::function<float(int x, int y)>;

Plane plane_of(int width, int height, const std::vector<Pattern>& components) {
  Plane plane{"ao", {}};
  for (const Pattern& pattern : components) {
    Channel channel(Layout(width, height), nan);  // reading padding would be noticed
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) channel.at(x, y) = pattern(x, y);
    plane.channels.push_back(std::move(channel));
  }
  return plane;
}

Plane row_of(const std::vector<float>& values) {
  return plane_of(int(values.size()), 1, {[&](int x, int) { return values[size_t(x)]; }});
}

Plane noise(int width, int height, unsigned seed, size_t components = 1) {
  std::mt19937 engine(seed);
  const Pattern pattern = [&engine](int, int) { return float(engine() >> 8) * 0x1p-24f; };
  return plane_of(width, height, std::vector<Pattern>(components, pattern));
}

/// Smooth, with an edge: material for windows and gradients.
float scene(int x, int y) {
  return 0.5f + 0.3f * std::sin(0.31f * float(x)) * std::cos(0.17f * float(y)) + 0.1f * float(x > y);
}

Mask everywhere(const Plane& plane) {
  const Layout& layout = plane.channels[0].layout();
  return Mask(size_t(layout.width) * size_t(layout.height), 1);
}

Metrics compare_all(const Plane& test, const Plane& truth) { return compare(test, truth, everywhere(test)); }

void expect_same_bits(const Metrics& a, const Metrics& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.mae, b.mae);
  EXPECT_EQ(a.rmse, b.rmse);
  EXPECT_EQ(a.bias, b.bias);
  EXPECT_EQ(a.psnr, b.psnr);
  EXPECT_EQ(a.max, b.max);
  EXPECT_EQ(a.over_1_255, b.over_1_255);
  EXPECT_EQ(a.over_0_05, b.over_0_05);
  EXPECT_EQ(a.ssim, b.ssim);
  EXPECT_EQ(a.gmsd, b.gmsd);
}

void expect_error(const Plane& test, const Plane& truth, const Mask& mask, const std::vector<std::string>& words) {
  try {
    compare(test, truth, mask);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    for (const std::string& word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << " lacks: " << word;
  }
}

cv::Mat times_255(const Channel& channel) {
  cv::Mat mat(channel.layout().height, channel.layout().width, CV_32F);
  for (int y = 0; y < mat.rows; ++y)
    for (int x = 0; x < mat.cols; ++x) mat.at<float>(y, x) = 255 * channel.at(x, y);
  return mat;
}

TEST(Metrics, SimpleFiguresByHand) {
  // Differences 0.25, -0.5, 0, 0.03125: exact in float.
  const Metrics m = compare_all(row_of({0.5f, 0.25f, 1, 0.53125f}), row_of({0.25f, 0.75f, 1, 0.5f}));
  EXPECT_EQ(m.pixels, 4);
  EXPECT_DOUBLE_EQ(m.mae, 0.78125 / 4);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt((0.0625 + 0.25 + 0.0009765625) / 4));
  EXPECT_DOUBLE_EQ(m.bias, -0.21875 / 4);
  ASSERT_TRUE(m.psnr);
  EXPECT_DOUBLE_EQ(*m.psnr, -20 * std::log10(m.rmse));
  EXPECT_DOUBLE_EQ(m.max, 0.5);
  EXPECT_DOUBLE_EQ(m.over_1_255, 0.75);
  EXPECT_DOUBLE_EQ(m.over_0_05, 0.5);
}

TEST(Metrics, PsnrOfATenthIsTwentyDecibel) {
  const Metrics m = compare_all(row_of({0.1f, 0.1f}), row_of({0, 0}));
  ASSERT_TRUE(m.psnr);
  EXPECT_NEAR(*m.psnr, 20, 1e-6);
}

TEST(Metrics, PositiveBiasMeansTooBright) {
  EXPECT_GT(compare_all(row_of({1}), row_of({0.5f})).bias, 0);
  EXPECT_LT(compare_all(row_of({0.5f}), row_of({1})).bias, 0);
}

TEST(Metrics, SharesCountPixelsNotComponents) {
  const auto level = [](std::vector<float> values) -> Pattern {
    return [values](int x, int) { return values[size_t(x)]; };
  };
  // Pixel 0: one component over 0.05, another under it. Pixel 1: one over 1/255 only. Pixels 2 and 3: equal.
  const Plane test =
      plane_of(4, 1, {level({0.75f, 0.5f, 0, 1}), level({0.5f, 0.515625f, 0, 1}), level({0.25f, 0, 0, 1})});
  const Plane truth = plane_of(4, 1, {level({0.5f, 0.5f, 0, 1}), level({0.5f, 0.5f, 0, 1}), level({0.5f, 0, 0, 1})});
  const Metrics m = compare_all(test, truth);
  EXPECT_EQ(m.pixels, 4);
  EXPECT_DOUBLE_EQ(m.over_0_05, 0.25);
  EXPECT_DOUBLE_EQ(m.over_1_255, 0.5);
  EXPECT_DOUBLE_EQ(m.mae, (0.25 + 0.25 + 0.015625) / 12);
  EXPECT_DOUBLE_EQ(m.bias, 0.015625 / 12);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt((0.125 + 0.015625 * 0.015625) / 12));
}

TEST(Metrics, OnlyTheMaskCounts) {
  const Metrics m = compare(row_of({0.5f, 9, 0.25f}), row_of({0.25f, 0, 0.25f}), Mask{1, 0, 1});
  EXPECT_EQ(m.pixels, 2);
  EXPECT_DOUBLE_EQ(m.mae, 0.125);
  EXPECT_DOUBLE_EQ(m.max, 0.25);
}

TEST(Metrics, IdenticalImages) {
  for (const auto& [w, h] : {std::pair(1, 1), std::pair(5, 3), std::pair(64, 48), std::pair(33, 600)}) {
    const Plane image = noise(w, h, 1);
    const Metrics m = compare_all(image, image);
    EXPECT_EQ(m.rmse, 0);
    EXPECT_EQ(m.max, 0);
    EXPECT_FALSE(m.psnr);
    EXPECT_EQ(m.ssim, 1) << w << "x" << h;
    EXPECT_EQ(m.gmsd, 0) << w << "x" << h;
  }
}

TEST(Metrics, UnrelatedNoiseIsNotSimilar) {
  const Metrics m = compare_all(noise(256, 256, 1), noise(256, 256, 2));
  EXPECT_LT(m.ssim, 0.05);
  EXPECT_GT(m.gmsd, 0.1);
  EXPECT_NEAR(m.rmse, std::sqrt(1.0 / 6), 0.01);  // of the difference of two uniform variables
}

TEST(Metrics, SsimByHand) {
  // Flat images have no variance: (2 a b + c1) / (a^2 + b^2 + c1), c1 = (0.01 * 255)^2.
  const double a = 0.25 * 255, b = 0.75 * 255, c1 = 2.55 * 2.55;
  for (const auto& [w, h] : {std::pair(1, 1), std::pair(5, 3), std::pair(1, 40), std::pair(40, 1), std::pair(40, 40)}) {
    const auto flat = [&, w = w, h = h](float v) { return plane_of(w, h, {[v](int, int) { return v; }}); };
    EXPECT_NEAR(compare_all(flat(0.25f), flat(0.75f)).ssim, (2 * a * b + c1) / (a * a + b * b + c1), 1e-9);
  }
}

TEST(Metrics, GmsdByHand) {
  // 4x4 becomes 2x2 by averaging blocks. The truth is black: no gradient. The test has one block of 6/255 on top left.
  // Prewitt with zeros outside: every one of the four pixels sees that block. As a corner neighbour (bottom right) both
  // derivatives see it with weight 1/3; beside or below only one does, as the other has weight 0 there; on the block
  // itself both weights are 0.
  const Plane test = plane_of(4, 4, {[](int x, int y) { return x < 2 && y < 2 ? 6.0f / 255 : 0.0f; }});
  const Plane truth = plane_of(4, 4, {[](int, int) { return 0.0f; }});
  const double t = 170, q[4] = {1, t / (4 + t), t / (4 + t), t / (8 + t)};
  const double mean = (q[0] + q[1] + q[2] + q[3]) / 4;
  double variance = 0;
  for (double value : q) variance += (value - mean) * (value - mean) / 4;
  EXPECT_NEAR(compare_all(test, truth).gmsd, std::sqrt(variance), 1e-8);
  // With the right half as background, which is white in both: Prewitt sees 170 across and 85 down on the left of the
  // truth; on the lower left of the test 87 down instead, as the block of 6 is above it.
  Mask left(16, 0);
  for (size_t i = 0; i < 16; ++i) left[i] = i % 4 < 2;
  const double a2 = 170 * 170 + 87 * 87, b2 = 170 * 170 + 85 * 85, lower = (2 * std::sqrt(a2 * b2) + t) / (a2 + b2 + t);
  EXPECT_NEAR(compare(test, truth, left).gmsd, (1 - lower) / 2, 1e-9);
}

TEST(Metrics, AgreesWithOpenCvOverWholeImages) {
  cv::ocl::setUseOpenCL(false);
  // Sizes on both sides of a band and of OpenCV's rounding of half sizes.
  for (const auto& [w, h] : {std::pair(64, 48), std::pair(61, 255), std::pair(62, 257), std::pair(63, 258),
                             std::pair(21, 259), std::pair(40, 773), std::pair(5, 3), std::pair(2, 2)}) {
    const Plane truth = plane_of(w, h, {scene});
    const Plane test =
        plane_of(w, h, {[](int x, int y) { return scene(x + 1, y) + 0.05f * std::sin(float(7 * x + 3 * y)); }});
    const cv::Mat a = times_255(truth.channels[0]), b = times_255(test.channels[0]);
    const Metrics m = compare_all(test, truth);
    EXPECT_NEAR(m.ssim, cv::quality::QualitySSIM::compute(a, b, cv::noArray())[0], 1e-6) << w << "x" << h;
    EXPECT_NEAR(m.gmsd, cv::quality::QualityGMSD::compute(a, b, cv::noArray())[0], 1e-6) << w << "x" << h;
  }
}

TEST(Metrics, SimilarityIsTheMeanOverComponents) {
  const Pattern other = [](int x, int y) { return scene(y, x); };
  const Pattern third = [](int x, int y) { return 1 - scene(x, y); };
  const Metrics all = compare_all(plane_of(40, 30, {scene, scene, third}), plane_of(40, 30, {scene, other, other}));
  const auto alone = [&](const Pattern& a, const Pattern& b) {
    return compare_all(plane_of(40, 30, {a}), plane_of(40, 30, {b}));
  };
  const Metrics m1 = alone(scene, scene), m2 = alone(scene, other), m3 = alone(third, other);
  EXPECT_NEAR(all.ssim, (m1.ssim + m2.ssim + m3.ssim) / 3, 1e-12);
  EXPECT_NEAR(all.gmsd, (m1.gmsd + m2.gmsd + m3.gmsd) / 3, 1e-12);
}

TEST(Metrics, BackgroundValuesChangeNothing) {
  const int w = 61, h = 300;
  const auto counts = [](int x, int y) { return (x - 30) * (x - 30) + (y - 250) * (y - 250) / 9 < 500 || x % 17 == 3; };
  Mask mask;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) mask.push_back(counts(x, y));
  std::mt19937 engine(5);
  const auto with_background = [&](std::function<float()> background, float shift) {
    return plane_of(
        w, h, {[&, shift](int x, int y) { return counts(x, y) ? scene(x, y) + shift * float(y % 3) : background(); }});
  };
  const auto constant = [](float v) { return [v] { return v; }; };
  const auto random = [&] { return float(engine() >> 8) * 0x1p-20f - 8; };
  const Metrics plain = compare(with_background(constant(1), 0.02f), with_background(constant(1), 0), mask);
  EXPECT_LT(plain.ssim, 1);
  EXPECT_GT(plain.gmsd, 0);
  for (const auto& [a, b] :
       std::vector<std::pair<std::function<float()>, std::function<float()>>>{{random, random},
                                                                              {constant(nan), constant(0)},
                                                                              {constant(0), constant(infinity)},
                                                                              {constant(-1e30f), constant(nan)}})
    expect_same_bits(plain, compare(with_background(a, 0.02f), with_background(b, 0), mask));
}

TEST(Metrics, ExactWherePaintedOnBackgroundOnly) {
  // Every difference lies on background: the images count as identical.
  const Mask mask{1, 1, 0, 0, 1, 1};
  const Metrics m = compare(row_of({0, 0.5f, 1, 0, 0.25f, 1}), row_of({0, 0.5f, 0, 1, 0.25f, 1}), mask);
  EXPECT_FALSE(m.psnr);
  EXPECT_EQ(m.ssim, 1);
  EXPECT_EQ(m.gmsd, 0);
}

TEST(Metrics, TinyImagesAreDefined) {
  for (int w : {1, 2, 3, 5, 11})
    for (int h : {1, 2, 3, 5, 11}) {
      const Metrics m = compare_all(noise(w, h, 1, 3), noise(w, h, 2, 3));
      EXPECT_EQ(m.pixels, w * h);
      EXPECT_TRUE(m.ssim >= -1 && m.ssim <= 1) << w << "x" << h << ": " << m.ssim;
      EXPECT_TRUE(m.gmsd >= 0 && m.gmsd <= 1) << w << "x" << h << ": " << m.gmsd;
    }
  // One map pixel has no deviation.
  EXPECT_EQ(compare_all(row_of({0}), row_of({1})).gmsd, 0);
  // OpenCV's map of a 5 pixel wide image ends before the last column.
  EXPECT_EQ(compare(row_of({0, 0, 0, 0, 0}), row_of({1, 1, 1, 1, 1}), Mask{0, 0, 0, 0, 1}).gmsd, 0);
}

TEST(Metrics, LongImages) {
  EXPECT_LT(compare_all(noise(16384, 1, 1), noise(16384, 1, 2)).ssim, 0.2);
  EXPECT_LT(compare_all(noise(1, 16384, 1), noise(1, 16384, 2)).ssim, 0.2);
}

TEST(Metrics, HugeValuesStayDefined) {
  const Plane big = plane_of(20, 20, {[](int x, int y) { return 3e38f * float((x + y) % 2); }});
  const Metrics m = compare_all(big, plane_of(20, 20, {[](int, int) { return 1e9f; }}));
  EXPECT_TRUE(std::isfinite(m.rmse) && std::isfinite(m.ssim) && std::isfinite(m.gmsd));
  EXPECT_TRUE(m.ssim >= -1 && m.ssim <= 1);
}

TEST(Metrics, SameBitsForAnyNumberOfThreads) {
  const Plane a = noise(300, 300, 1), b = noise(300, 300, 2);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const Metrics one = compare_all(a, b);
  cv::setNumThreads(8);
  const Metrics eight = compare_all(a, b);
  cv::setNumThreads(threads);
  expect_same_bits(one, eight);
}

TEST(Metrics, NamesThePixelThatIsNotFinite) {
  const Plane good = plane_of(3, 2, {[](int, int) { return 0.5f; }});
  const auto bad = [](float value) {
    return plane_of(3, 2, {[=](int x, int y) { return x == 2 && y == 1 ? value : 0.5f; }});
  };
  expect_error(bad(nan), good, everywhere(good), {"test", "nan", "(2, 1)", "ao"});
  expect_error(good, bad(-infinity), everywhere(good), {"truth", "-inf", "(2, 1)"});
  EXPECT_EQ(compare(bad(nan), good, Mask{1, 1, 1, 1, 1, 0}).pixels, 5);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  const Plane three = row_of({0, 0, 0}), four = row_of({0, 0, 0, 0});
  expect_error(three, four, Mask(3, 1), {"3x1", "4x1"});
  expect_error(three, noise(3, 1, 1, 3), Mask(3, 1), {"1 component", "3 components"});
  expect_error(three, three, Mask(4, 1), {"mask", "4"});
  expect_error(three, three, Mask(3, 0), {"background"});
  expect_error(Plane{"ao", {}}, Plane{"ao", {}}, Mask(), {"nothing"});
}

Plane colours(Plane plane) {
  plane.name = "color";
  return plane;
}

TEST(Metrics, ColoursHaveFlipAndRelativeSquaredError) {
  const std::vector<Pattern> grey(3, [](int, int) { return 0.5f; }), dark(3, [](int, int) { return 0.25f; });
  const Metrics m = compare_all(colours(plane_of(40, 30, dark)), colours(plane_of(40, 30, grey)));
  ASSERT_TRUE(m.flip && m.rse);
  EXPECT_NEAR(*m.flip, 0.4518496411120435, 1e-7);  // see flip_test.cpp
  EXPECT_NEAR(*m.rse, 0.0625 / 0.26, 1e-12);
  const Metrics ao = compare_all(plane_of(40, 30, {grey[0]}), plane_of(40, 30, {dark[0]}));
  EXPECT_FALSE(ao.flip || ao.rse);
}

TEST(Metrics, FlipOfATallImageIsThatOfTheWhole) {
  // Higher than a band.
  const std::vector<Pattern> pattern(3, scene), moved(3, [](int x, int y) { return scene(x + 1, y); });
  const Plane test = colours(plane_of(40, 600, moved)), truth = colours(plane_of(40, 600, pattern));
  const auto whole = [](const Plane& plane) {
    cv::Mat image(600, 40, CV_64FC3);
    for (int y = 0; y < 600; ++y) {
      for (int x = 0; x < 40; ++x) image.at<cv::Vec3d>(y, x) = cv::Vec3d::all(double(plane.channels[0].at(x, y)));
    }
    return image;
  };
  EXPECT_NEAR(*compare_all(test, truth).flip, cv::mean(flip_map(whole(test), whole(truth)))[0], 1e-9);
}

TEST(Metrics, BackgroundOfColoursSaysNothing) {
  Plane test = colours(noise(64, 48, 1, 3)), truth = colours(noise(64, 48, 1, 3));
  Mask mask(64 * 48, 1);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 20; ++x) {
      mask[size_t(y * 64 + x)] = 0;
      test.channels[1].at(x, y) = infinity;
    }
  }
  EXPECT_EQ(*compare(test, truth, mask).flip, 0);
  EXPECT_EQ(*compare(test, truth, mask).rse, 0);
}

}  // namespace
}  // namespace gloam::metrics_test
