// Letters of pictures: of a font where this machine has one, of strokes where it has none, and text of both in UTF-8.
#include "picture/letters.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "picture/font.h"
#include "picture/picture.h"

namespace gloam::letters_test {
namespace {

/// Rows and columns that a line covers by a half or more.
cv::Rect covered(const Letters& letters, const std::u32string& text, double size, bool bold) {
  cv::Mat coverage(200, 1000, CV_8UC1, cv::Scalar(0));
  letters.draw(coverage, text, {50, 150}, size, bold);
  std::vector<cv::Point> pixels;
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x)
      if (coverage.at<unsigned char>(y, x) > 127) pixels.emplace_back(x, y);
  return pixels.empty() ? cv::Rect() : cv::boundingRect(pixels);
}

/// Strokes, and the font if there is one.
std::vector<std::unique_ptr<Letters>> both_kinds() {
  std::vector<std::unique_ptr<Letters>> kinds;
  kinds.push_back(stroke_letters());
  if (auto font = font_letters()) kinds.push_back(std::move(font));
  return kinds;
}

TEST(Letters, CapitalsAreAsHighAsSaidAndStandOnTheLine) {
  for (const auto& letters : both_kinds())
    for (const bool bold : {false, true})
      for (const double size : {20.0, 40.0, 80.0}) {
        const cv::Rect at = covered(*letters, U"HE", size, bold);
        const double stroke = 0.2 * size;  // half a stroke goes beyond
        EXPECT_NEAR(at.height, size, stroke + 1) << size;
        EXPECT_NEAR(at.br().y, 150, stroke / 2 + 1) << size;
      }
}

TEST(Letters, ALineIsAsWideAsItIsSaidToBe) {
  for (const auto& letters : both_kinds())
    for (const bool bold : {false, true}) {
      const double width = letters->width(U"HamburgefontivH", 30, bold);
      const cv::Rect at = covered(*letters, U"HamburgefontivH", 30, bold);
      EXPECT_GE(at.x, 50 - 3);
      EXPECT_LE(at.br().x, 50 + width + 3);
      EXPECT_GE(at.width, width - 12);
      EXPECT_NEAR(letters->width(U"HamburgefontivH", 60, bold), 2 * width, 2);
    }
}

TEST(Letters, TheFontOfTheMachineIsTaken) {
  const bool is_there = std::filesystem::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf");
  if (!is_there || !GLOAM_FREETYPE) GTEST_SKIP() << "no font, or a build without FreeType";
  EXPECT_TRUE(letters().has(U'\u00e9'));
  EXPECT_GT(letters().width(U"M", 100, false), 2 * letters().width(U"i", 100, false));
}

TEST(Letters, WhereNoFontIsThereAreStrokes) {
  EXPECT_EQ(font_letters({}), nullptr);
  EXPECT_EQ(font_letters({{"/no/such/font.ttf", "/no/such/bold.ttf"}, {"/proc/self/status", "/proc/self/status"}}),
            nullptr);
  EXPECT_FALSE(stroke_letters()->has(U'\u00e9'));
  EXPECT_TRUE(stroke_letters()->has(U'e'));
}

TEST(Letters, WhatCannotBeDrawnIsAQuestionMark) {
  EXPECT_EQ(drawable("plain text 0.5 %"), "plain text 0.5 %");
  EXPECT_EQ(drawable("a\nb"), "a?b");
  EXPECT_EQ(drawable("a\xff\xc3"), "a??");
  EXPECT_EQ(drawable("\xf4\x8f\xbf\xbd!"), "?!");  // the last character for private use
  EXPECT_EQ(drawable("\xc3\xa9t\xc3\xa9"), letters().has(U'\u00e9') ? "\xc3\xa9t\xc3\xa9" : "?t?");
}

TEST(Letters, LongTextsAreCutBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 200; ++i) name += "\xc3\xa9";
  for (double width = 20; width < 60; width += 3.1) {
    const std::string cut = shortened(name, width, {10});
    EXPECT_EQ(drawable(cut), cut);
    EXPECT_LE(text_width(cut, {10}), std::max(width, text_width("...", {10})));
    EXPECT_NE(cut.find("..."), std::string::npos);
  }
}

}  // namespace
}  // namespace gloam::letters_test
