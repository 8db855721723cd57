#include "gloam/visualise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "gloam/error.h"
#include "unit/pictures.h"

namespace gloam::visualise_test {
namespace {

using namespace test;
namespace fs = std::filesystem;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Visualise : public test::PictureTest {
 protected:
  Picture difference(const Plane& test, const Plane& truth, const Mask& mask,
                     const DifferencePicture& options = {"a.exr", "b.exr"}, const std::string& name = "d.png") {
    write_difference_picture(folder / name, test, truth, mask, compare(test, truth, mask), options);
    return picture_in(folder / name);
  }
  Picture single(const Plane& plane) {
    write_picture(folder / "p.png", plane);
    return picture_in(folder / "p.png");
  }
};

/// Positions of the panels of a sheet of full-size or enlarged images, from the layout: equal margins and gaps.
struct Panels {
  int box, first, step, top;
  explicit Panels(const Picture& p, int box) : box(box) {
    const double unit = std::min(std::max(box / 420.0, 1.0), 1.9);
    first = int(std::lround(24 * unit));
    step = box + int(std::lround(18 * unit));
    top = int(std::lround(98 * unit));
    EXPECT_EQ(p.width, 2 * first + 2 * step + box);
  }
  /// Middle of a panel `height` pixels high.
  Pixel middle(const Picture& p, int panel, int height) const {
    return p.at(first + panel * step + box / 2, top + height / 2);
  }
};

bool is_neutral(const Pixel& p) { return p.r == p.g && p.g == p.b; }

TEST_F(Visualise, OneComponentIsGreyWithoutACurve) {
  const Plane plane = patterned_plane("ao", 5, 1, {[](int x, int) {
                                        return std::vector<float>{0, 0.5f, 1, 2, -1}[size_t(x)];
                                      }});
  const Picture p = single(plane);
  ASSERT_EQ(p.width, 5);
  ASSERT_EQ(p.height, 1);
  for (const auto& [x, v] : {std::pair(0, 0), std::pair(1, 128), std::pair(2, 255), std::pair(3, 255), std::pair(4, 0)})
    EXPECT_EQ(p.at(x, 0), (Pixel{v, v, v})) << x;
}

TEST_F(Visualise, ColoursGoThroughSrgb) {
  const Picture p = single(patterned_plane("color", 2, 3, {level(0.5f), level(0.001f), level(7)}));
  ASSERT_EQ(p.height, 3);
  EXPECT_EQ(p.at(1, 2), (Pixel{188, 3, 255}));
}

/// The table against the curve (IEC 61966-2-1), at values of all sizes and next to each byte's least value.
TEST_F(Visualise, SrgbIsExactForEveryByte) {
  const auto byte_of = [](double v) {
    const double curve = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return int(std::lrint(255 * curve));
  };
  std::vector<float> values;
  for (int i = 0; i < 20000; ++i) values.push_back(std::pow(10.0f, -6.0f * float(i) / 20000));
  for (int byte = 0; byte < 255; ++byte) {
    const double curve = (byte + 0.5) / 255;
    const float edge = float(curve <= 0.04045 ? curve / 12.92 : std::pow((curve + 0.055) / 1.055, 2.4));
    for (const float away : {0.99999f, 1.00001f}) values.push_back(edge * away);
  }
  const int width = int(values.size());
  const Pattern pattern = [&](int x, int) { return values[size_t(x)]; };
  const Picture p = single(patterned_plane("color", width, 1, {pattern, level(-3), level(1e30f)}));
  for (int x = 0; x < width; ++x)
    ASSERT_EQ(p.at(x, 0), (Pixel{byte_of(values[size_t(x)]), 0, 255})) << values[size_t(x)];
}

TEST_F(Visualise, NormalsAreCentredOnGrey) {
  const Picture p = single(patterned_plane("normal", 1, 1, {level(-1), level(0), level(1)}));
  EXPECT_EQ(p.at(0, 0), (Pixel{0, 128, 255}));
}

TEST_F(Visualise, WhatIsNotANumberIsBlack) {
  EXPECT_EQ(single(patterned_plane("ao", 1, 1, {level(nan)})).at(0, 0), (Pixel{0, 0, 0}));
  EXPECT_EQ(single(patterned_plane("color", 1, 1, {level(nan), level(nan), level(nan)})).at(0, 0), (Pixel{0, 0, 0}));
}

TEST_F(Visualise, TwoComponentsAreRedAndGreen) {
  EXPECT_EQ(single(patterned_plane("motion", 1, 1, {level(1), level(0)})).at(0, 0), (Pixel{255, 0, 0}));
}

TEST_F(Visualise, ShowsTestTruthAndTheSignOfTheDifference) {
  const Mask mask(400 * 100, 1);
  const auto sheet = [&](float test, float truth) {
    return difference(patterned_plane("ao", 400, 100, {level(test)}), patterned_plane("ao", 400, 100, {level(truth)}),
                      mask);
  };
  const Picture bright = sheet(0.8f, 0.4f), dark = sheet(0.4f, 0.8f), equal = sheet(0.4f, 0.4f);
  const Panels panels(bright, 400);
  EXPECT_EQ(panels.middle(bright, 0, 100), (Pixel{204, 204, 204}));
  EXPECT_EQ(panels.middle(bright, 1, 100), (Pixel{102, 102, 102}));
  const Pixel red = panels.middle(bright, 2, 100), blue = panels.middle(dark, 2, 100),
              white = panels.middle(equal, 2, 100);
  EXPECT_GT(red.r, red.b + 80) << red;
  EXPECT_GT(blue.b, blue.r + 80) << blue;
  EXPECT_TRUE(is_neutral(white) && white.r > 240) << white;
}

TEST_F(Visualise, RangeSetsTheEndsOfTheColours) {
  const Plane test = patterned_plane("ao", 400, 100, {level(0.54f)}),
              truth = patterned_plane("ao", 400, 100, {level(0.5f)});
  const auto colour = [&](float range) {
    const Picture p = difference(test, truth, Mask(400 * 100, 1), {"a", "b", range});
    return Panels(p, 400).middle(p, 2, 100);
  };
  EXPECT_EQ(colour(0), colour(0.05f));         // the smallest range offered covers 0.04
  EXPECT_EQ(colour(0.02f), colour(0.01f));     // both beyond the end
  EXPECT_LT(colour(0.05f).g, colour(0.5f).g);  // deeper
}

TEST_F(Visualise, RangeCoversNinetyNineInHundred) {
  // 1 % of the pixels differ by 0.9, the others by 0.15: the range is 0.2, so 0.15 looks as with 0.2 given.
  const Plane truth = patterned_plane("ao", 400, 100, {level(0)});
  const Plane test = patterned_plane("ao", 400, 100, {[](int x, int y) { return y == 0 && x < 400 ? 0.9f : 0.15f; }});
  const Mask mask(400 * 100, 1);
  difference(test, truth, mask, {"a", "b", 0}, "chosen.png");
  difference(test, truth, mask, {"a", "b", 0.2f}, "given.png");
  EXPECT_EQ(bytes_of(folder / "chosen.png"), bytes_of(folder / "given.png"));
}

TEST_F(Visualise, OneComponentOffShowsInColours) {
  const Plane truth = patterned_plane("color", 400, 100, {level(0.5f), level(0.5f), level(0.5f)});
  const Plane test = patterned_plane("color", 400, 100, {level(0.4f), level(0.52f), level(0.58f)});
  const Picture p = difference(test, truth, Mask(400 * 100, 1));
  const Pixel blue = Panels(p, 400).middle(p, 2, 100);  // -0.1 is the largest, the mean is 0
  EXPECT_GT(blue.b, blue.r + 80) << blue;
}

TEST_F(Visualise, BackgroundValuesAreNotSeen) {
  Mask mask(400 * 100, 1);
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % 400 < 150;
  const auto with = [&](float background) {
    return patterned_plane("ao", 400, 100, {[=](int x, int y) { return x < 150 ? float(x + y) / 300 : background; }});
  };
  const Picture p = difference(with(1), with(1), mask, {"a", "b"}, "one.png");
  difference(with(nan), with(-70), mask, {"a", "b"}, "two.png");
  EXPECT_EQ(bytes_of(folder / "one.png"), bytes_of(folder / "two.png"));
  const Panels panels(p, 400);
  for (int panel : {0, 1, 2}) {
    const Pixel grey = panels.middle(p, panel, 100);
    EXPECT_TRUE(is_neutral(grey) && grey.r < 230) << grey;  // darker than any neutral colour of the map
  }
}

TEST_F(Visualise, SheetsOfEverySizeAreReadable) {
  const std::vector<std::pair<int, int>> sizes{{1, 1},    {5, 3},    {17, 13},   {320, 200}, {700, 30},
                                               {30, 700}, {1280, 8}, {1900, 60}, {16384, 1}, {1, 16384}};
  for (const auto& [w, h] : sizes)
    for (size_t components : {1, 3}) {
      const std::string name = components == 1 ? "ao" : "color";
      const std::vector<Pattern> a(components, [](int x, int y) { return float((x * 7 + y * 3) % 11) / 11; });
      const std::vector<Pattern> b(components, [](int x, int y) { return float((x * 3 + y * 5) % 13) / 13; });
      const Picture p =
          difference(patterned_plane(name, w, h, a), patterned_plane(name, w, h, b), Mask(size_t(w) * size_t(h), 1));
      EXPECT_GE(p.width, 3 * 320) << w << "x" << h;
      EXPECT_LE(p.width, 4000) << w << "x" << h;
      EXPECT_LE(p.height, 3200) << w << "x" << h;
      EXPECT_EQ(p.at(0, 0), (Pixel{255, 255, 255}));
      EXPECT_EQ(p.at(p.width - 1, p.height - 1), (Pixel{255, 255, 255}));
    }
}

TEST_F(Visualise, LongNamesStayInsideTheMargin) {
  const Plane plane = patterned_plane("ao", 8, 8, {level(0.5f)});
  for (const std::string& name : {std::string(5000, 'W'), std::string(5000, 'i'), std::string("\xc3\xa9t\xc3\xa9.exr"),
                                  std::string("\n\xff\x80"), std::string()}) {
    const Picture p = difference(plane, plane, Mask(64, 1), {name, name});
    for (int y = 0; y < 90; ++y)
      for (int x : {0, 10, 20, p.width - 21, p.width - 11, p.width - 1})
        EXPECT_EQ(p.at(x, y), (Pixel{255, 255, 255})) << x << " " << y;
  }
}

TEST_F(Visualise, FiguresOfAnySizeAreDrawn) {
  const Plane a = patterned_plane("depth", 40, 30, {level(1e30f)}),
              b = patterned_plane("depth", 40, 30, {level(-3e-9f)});
  EXPECT_GT(difference(a, b, Mask(1200, 1)).width, 0);
}

TEST_F(Visualise, SaysWhatCannotBeDrawn) {
  const Plane small = patterned_plane("ao", 3, 2, {level(0)}), large = patterned_plane("ao", 4, 2, {level(0)});
  const fs::path path = folder / "x.png";
  EXPECT_THROW(write_difference_picture(path, small, large, Mask(6, 1), {}, {}), Error);
  EXPECT_THROW(write_difference_picture(path, small, small, Mask(7, 1), {}, {}), Error);
  EXPECT_THROW(write_picture(path, Plane{"ao", {}}), Error);
  EXPECT_THROW(write_picture(folder / "missing" / "x.png", small), Error);
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace gloam::visualise_test
