#include "gloam/stereo_pictures.h"

#include <gtest/gtest.h>

#include "unit/message_of.h"
#include "unit/pictures.h"

namespace gloam::stereo_pictures_test {
namespace {

using namespace test;

class StereoPictures : public PictureTest {};

/// Grey levels are whole numbers of 255, so that rounding does not matter.
float grey(int byte) { return float(byte) / 255; }

StereoErrors errors_of(const std::vector<StereoPixel>& pixels, const std::vector<float>& values) {
  StereoErrors errors;
  errors.pixels = pixels;
  errors.error = Channel(Layout(int(values.size()), 1), 0);
  for (size_t x = 0; x < values.size(); ++x) errors.error.at(int(x), 0) = values[x];
  return errors;
}

/// A picture of 320 pixels has the legend of one that has room for it, entry by entry.
TEST_F(StereoPictures, TheLegendIsNotCutBelowASmallPicture) {
  const auto purple_and_ink = [&](int width) {
    const auto path = folder / "legend.png";
    StereoErrors errors = errors_of(std::vector<StereoPixel>(size_t(width), StereoPixel::background),
                                    std::vector<float>(size_t(width), 0));
    write_inconsistency_picture(path, patterned_plane("ao", width, 1, {[](int, int) { return 1.0f; }}), errors, 20);
    const Picture picture = picture_in(path);
    int dark = 0;
    for (int y = 1; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Pixel p = picture.at(x, y);
        dark += p.r < 60 && p.g < 60 && p.b < 60;
      }
    return dark;
  };
  const int in_full = purple_and_ink(1200);
  EXPECT_GT(in_full, 200);
  for (const int width : {1, 64, 320, 400}) EXPECT_EQ(purple_and_ink(width), in_full) << width;
}

TEST_F(StereoPictures, ErrorsAreMagnifiedGreyAndWhatDoesNotCountIsPurpleOverThePlane) {
  const auto path = folder / "errors.png";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  using P = StereoPixel;
  const StereoErrors errors =
      errors_of({P::counted, P::counted, P::counted, P::hidden, P::outside, P::edge, P::background},
                {0, grey(5), grey(200), nan, nan, nan, nan});
  const Plane ao = patterned_plane("ao", 7, 1, {[](int x, int) { return x == 4 ? 0.0f : 1.0f; }});
  write_inconsistency_picture(path, ao, errors, 20);
  const Picture picture = picture_in(path);
  // The image, and a legend under it: the scale from black to white, purple, and hatching.
  ASSERT_GT(picture.width, 320);
  ASSERT_GT(picture.height, 1 + 3 * 12);
  int purple_pixels = 0, dark_pixels = 0;
  for (int y = 1; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Pixel p = picture.at(x, y);
      purple_pixels += p.r > p.g + 20 && p.b > p.g + 20;
      dark_pixels += p.r < 100 && p.r == p.g && p.g == p.b;
    }
  }
  EXPECT_GT(purple_pixels, 200);
  EXPECT_GT(dark_pixels, 200);
  EXPECT_EQ(picture.at(0, 0), (Pixel{0, 0, 0}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{100, 100, 100}));
  EXPECT_EQ(picture.at(2, 0), (Pixel{255, 255, 255}));
  const Pixel bright = picture.at(3, 0), dark = picture.at(4, 0), background = picture.at(6, 0);
  for (const Pixel& purple : {bright, dark}) {
    EXPECT_GT(purple.r, purple.g + 20);
    EXPECT_GT(purple.b, purple.g + 20);
  }
  EXPECT_GT(bright.g, dark.g + 100) << "the plane shows through";
  EXPECT_EQ(picture.at(5, 0), bright);
  EXPECT_EQ(background.r, background.g);
  EXPECT_EQ(background.g, background.b);
}

TEST_F(StereoPictures, TheAnaglyphIsRedOfTheLeftAndCyanOfTheRight) {
  const auto path = folder / "both.png";
  write_anaglyph(path, patterned_plane("ao", 3, 2, {level(grey(40))}), patterned_plane("ao", 3, 2, {level(grey(90))}));
  const Picture picture = picture_in(path);
  ASSERT_EQ(picture.width, 3);
  ASSERT_EQ(picture.height, 2);
  EXPECT_EQ(picture.at(2, 1), (Pixel{40, 90, 90}));
  // Colours too: 1 and 0 are the same through any curve.
  write_anaglyph(path, patterned_plane("color", 3, 2, {level(1), level(0), level(0)}),
                 patterned_plane("color", 3, 2, {level(0), level(1), level(0)}));
  EXPECT_EQ(picture_in(path).at(0, 0), (Pixel{255, 255, 0}));
}

TEST_F(StereoPictures, TheLeftViewIsOnTheLeft) {
  const auto path = folder / "both.png";
  write_side_by_side(path, patterned_plane("ao", 3, 2, {level(grey(40))}),
                     patterned_plane("ao", 3, 2, {level(grey(90))}));
  const Picture picture = picture_in(path);
  ASSERT_EQ(picture.width, 6);
  ASSERT_EQ(picture.height, 2);
  EXPECT_EQ(picture.at(2, 1), (Pixel{40, 40, 40}));
  EXPECT_EQ(picture.at(3, 0), (Pixel{90, 90, 90}));
}

TEST_F(StereoPictures, ViewsOfDifferentSizeAreRefused) {
  const Plane small = patterned_plane("ao", 3, 2, {level(0)}), large = patterned_plane("ao", 4, 2, {level(0)});
  for (const auto write : {write_anaglyph, write_side_by_side}) {
    const std::string message = message_of([&] { write(folder / "both.png", small, large); });
    EXPECT_NE(message.find("the left image is 3x2 and the right one 4x2"), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace gloam::stereo_pictures_test
