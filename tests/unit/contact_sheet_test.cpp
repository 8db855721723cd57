#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"
#include "unit/pictures.h"

namespace gloam::contact_sheet_test {
namespace {

using namespace test;
constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

const Pixel white{255, 255, 255}, tone{214, 214, 214}, line{186, 186, 186}, magenta{255, 0, 255};

/// Positions of the tiles, from the layout: equal margins and gaps, two lines of text above each tile, a scale in the header if
/// there are depths.
struct Grid {
  int box, image_height;
  double unit;
  bool has_depth;
  Grid(int box, int image_height, bool has_depth)
      : box(box), image_height(image_height), unit(std::clamp(box / 480.0, 0.8, 1.9)), has_depth(has_depth) {}
  int px(double v) const { return int(std::lrint(v * unit)); }
  int left(int column) const { return px(24) + column * (box + px(18)); }
  int top(int row) const { return px(has_depth ? 108 : 70) + px(38) + row * (px(38) + image_height + px(18)); }
  int width(int columns) const { return left(columns) - px(18) + px(24); }
  int height(int rows) const { return top(rows) - px(38) - px(18) + px(24); }
};

Frame frame_of(std::vector<Plane> planes) {
  Frame frame;
  const Layout layout = planes.front().channels.front().layout();
  frame.display = frame.window = {0, 0, layout.width, layout.height};
  frame.views.emplace_back();
  for (Plane& plane : planes) {
    const std::string name = plane.name;
    frame.views[0].planes[name] = std::move(plane);
  }
  return frame;
}

template <typename... Planes>
Frame frame_with(Planes... planes) {
  std::vector<Plane> list;
  (list.push_back(std::move(planes)), ...);
  return frame_of(std::move(list));
}

class ContactSheetTest : public PictureTest {
 protected:
  Picture sheet(const Frame& frame, const ContactSheet& options = {"a.exr"}) {
    write_contact_sheet(folder / "sheet.png", frame, options);
    return picture_in(folder / "sheet.png");
  }
};

/// A plane of 96 x 54 pixels: drawn five times as large in a tile of 480.
Plane small(const std::string& name, const std::vector<Pattern>& components) {
  return patterned_plane(name, 96, 54, components);
}

TEST_F(ContactSheetTest, HasATileForEachPlaneInTheOrderOfTheirKinds) {
  const Picture p = sheet(frame_with(small("zebra", {level(1)}), small("ao", {level(1)}), small("alpha", {level(0)}),
                                     small("albedo", {level(0.5f), level(0), level(0)})));
  const Grid grid(480, 270, false);
  EXPECT_EQ(p.width, grid.width(2));
  EXPECT_EQ(p.height, grid.height(2));
  EXPECT_EQ(p.at(grid.left(0), grid.top(0)), (Pixel{0, 0, 0}));                // alpha
  EXPECT_EQ(p.at(grid.left(1) + 479, grid.top(0) + 269), (Pixel{188, 0, 0}));  // albedo, through sRGB
  EXPECT_EQ(p.at(grid.left(0) + 479, grid.top(1) + 269), white);               // ao
  EXPECT_EQ(p.at(grid.left(1), grid.top(1)), (Pixel{128, 128, 128}));          // one value: middle grey
}

TEST_F(ContactSheetTest, LargeImagesAreReducedToTheTileAndSmallOnesEnlargedByAWholeFactor) {
  const auto size_of = [&](int width, int height, int tile) {
    const Picture p = sheet(frame_with(patterned_plane("ao", width, height, {level(0)})), {"a", tile});
    const Grid grid(tile, 0, false);
    int w = 0, h = 0;
    while (p.at(grid.left(0) + w, grid.top(0)) == Pixel{0, 0, 0}) ++w;
    while (p.at(grid.left(0), grid.top(0) + h) == Pixel{0, 0, 0}) ++h;
    return std::pair(w, h);
  };
  EXPECT_EQ(size_of(960, 540, 240), std::pair(240, 135));
  EXPECT_EQ(size_of(960, 540, 480), std::pair(480, 270));
  EXPECT_EQ(size_of(100, 50, 480), std::pair(400, 200));
  EXPECT_EQ(size_of(1, 1, 480), std::pair(480, 480));
  EXPECT_EQ(size_of(100, 4000, 240), std::pair(24, 480));  // too narrow to be seen: widened
}

TEST_F(ContactSheetTest, ReducedColoursAreAveragedAndIdentitiesAreNot) {
  const Pattern stripes = [](int x, int) { return float(x % 2); };
  const Grid grid(480, 270, false);
  const auto instance_colour = [&](const Pattern& ids) {
    return sheet(frame_with(patterned_plane("instance", 960, 540, {ids}))).at(grid.left(0) + 100, grid.top(0) + 100);
  };
  const Picture p =
      sheet(frame_with(patterned_plane("ao", 960, 540, {stripes}), patterned_plane("instance", 960, 540, {stripes})));
  const Pixel even = instance_colour(level(0)), odd = instance_colour(level(1));
  EXPECT_NE(even, odd);
  for (int x = 0; x < 480; ++x) {
    const Pixel id = p.at(grid.left(0) + x, grid.top(0) + 100);
    ASSERT_TRUE(id == even || id == odd) << x << ": " << id;
    ASSERT_NEAR(p.at(grid.left(1) + x, grid.top(0) + 100).r, 128, 1) << x;
  }
}

TEST_F(ContactSheetTest, OneDepthHasOneColourInAllTilesAndNearIsBrighter) {
  const Pattern ramp = [](int x, int) { return x < 48 ? 2.0f : 40.0f; };
  const Picture p = sheet(frame_with(small("depth", {ramp}), small("back_depth", {level(40)}),
                                     small("peel.00", {level(2)}), small("peel.01", {level(8)})));
  const Grid grid(480, 270, true);
  const auto at = [&](int column, int row, int x) { return p.at(grid.left(column) + x, grid.top(row) + 100); };
  const Pixel near = at(0, 0, 50), far = at(0, 0, 400), middle = at(1, 1, 200);
  EXPECT_EQ(at(1, 0, 200), far);
  EXPECT_EQ(at(0, 1, 200), near);
  EXPECT_GT(near.g, middle.g + 40);
  EXPECT_GT(middle.g, far.g + 40);
}

TEST_F(ContactSheetTest, DepthsOfSeveralViewsShareTheScale) {
  Frame frame = frame_with(small("depth", {level(2)}));
  frame.views[0].name = "left";
  frame.views.emplace_back();
  frame.views[1].name = "right";
  frame.views[1].planes["depth"] = small("depth", {[](int x, int) { return x < 48 ? 2.0f : 9.0f; }});
  const Picture p = sheet(frame);
  const Grid grid(480, 270, true);
  ASSERT_EQ(p.height, grid.height(2));
  const Pixel left = p.at(grid.left(0) + 50, grid.top(0) + 100);
  EXPECT_EQ(left, p.at(grid.left(0) + 50, grid.top(1) + 100));
  EXPECT_NE(left, p.at(grid.left(0) + 400, grid.top(1) + 100));
}

TEST_F(ContactSheetTest, BackgroundIsHatchedButTheSkyHasItsColour) {
  const Pattern depth = [](int x, int) { return x < 48 ? 3.0f : inf; };
  const Picture p = sheet(frame_with(small("depth", {depth}), small("color", {level(0), level(0), level(1)}),
                                     small("ao", {level(1)}), small("peel.01", {level(inf)})));
  const Grid grid(480, 270, true);
  const auto hatched = [&](int column, int row, int from) {
    int tones = 0, lines = 0;
    for (int x = from; x < 480; ++x) {
      tones += p.at(grid.left(column) + x, grid.top(row) + 100) == tone;
      lines += p.at(grid.left(column) + x, grid.top(row) + 100) == line;
    }
    return tones > 100 && lines > 20 && tones + lines == 480 - from;
  };
  EXPECT_TRUE(hatched(0, 0, 240));
  EXPECT_FALSE(hatched(0, 0, 0));
  EXPECT_EQ(p.at(grid.left(1) + 400, grid.top(0) + 100), (Pixel{0, 0, 255}));
  EXPECT_TRUE(hatched(0, 1, 240));
  EXPECT_TRUE(hatched(1, 1, 0));
}

TEST_F(ContactSheetTest, WhatIsNotFiniteStandsOut) {
  const Picture p = sheet(frame_with(small("ao", {[](int x, int) { return x < 48 ? nan : 0.5f; }}),
                                     small("depth", {[](int x, int) { return x < 48 ? nan : 2.0f; }}),
                                     small("zebra", {[](int x, int) { return x < 48 ? -inf : 2.0f; }})));
  const Grid grid(480, 270, true);
  for (const auto& [column, row] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)}) {
    EXPECT_EQ(p.at(grid.left(column) + 100, grid.top(row) + 100), magenta) << column << row;
    EXPECT_NE(p.at(grid.left(column) + 400, grid.top(row) + 100), magenta) << column << row;
  }
}

TEST_F(ContactSheetTest, AFewOutliersDoNotWashOutTheRest) {
  const Pattern values = [](int x, int y) { return x == 0 && y == 0 ? 1e9f : x < 48 ? 1.0f : 2.0f; };
  const Picture p = sheet(frame_with(small("zebra", {values})));
  const Grid grid(480, 270, false);
  EXPECT_EQ(p.at(grid.left(0) + 100, grid.top(0) + 100), (Pixel{0, 0, 0}));
  EXPECT_EQ(p.at(grid.left(0) + 400, grid.top(0) + 100), white);
}

TEST_F(ContactSheetTest, MotionIsHueByDirectionAndBrightnessByLength) {
  const Picture p =
      sheet(frame_with(small("motion", {[](int x, int) { return x < 32   ? 8.0f
                                                                : x < 64 ? -8.0f
                                                                         : 0; }, level(0)})));
  const Grid grid(480, 270, false);
  const auto at = [&](int x) { return p.at(grid.left(0) + x, grid.top(0) + 100); };
  EXPECT_GT(at(50).r, at(50).g + 100);
  EXPECT_GT(at(240).g, at(240).r + 100);
  EXPECT_EQ(at(440), (Pixel{0, 0, 0}));
}

TEST_F(ContactSheetTest, LayersBeyondTheFirstFewAreCountedOnly) {
  std::vector<Plane> layers;
  for (int i = 0; i < 9; ++i) layers.push_back(small(layer_name("peel", i), {level(float(i + 1))}));
  const Frame frame = frame_of(std::move(layers));
  const Grid grid(480, 270, true);
  EXPECT_EQ(sheet(frame).height, grid.height(2));                    // 4
  EXPECT_EQ(sheet(frame, {"a", 480, 0, 0}).height, grid.height(3));  // all 9
  EXPECT_EQ(sheet(frame, {"a", 480, 1, 2}).height, grid.height(2));  // 2
  EXPECT_EQ(sheet(frame, {"a", 480, 5, 5}).width, grid.width(5));
}

TEST_F(ContactSheetTest, TextStaysOffTheTilesAndInsideTheMargin) {
  std::vector<Plane> planes;
  for (const std::string& name : {std::string(300, 'W'), std::string("\n\xff\x80"), std::string("position")})
    planes.push_back(small(name, std::vector<Pattern>(name == "position" ? 3 : 1, level(-1.2345e-30f))));
  planes.push_back(small("ao", {level(0.5f)}));
  const Frame frame = frame_of(std::move(planes));
  for (const int tile : {64, 240, 480, 1900}) {
    const Picture p = sheet(frame, {std::string(5000, 'W'), tile});
    const Grid grid(tile, 0, false);
    const int shown_width = tile >= 96 ? tile / 96 * 96 : tile;
    const Grid rows(tile, tile >= 96 ? tile / 96 * 54 : int(std::lrint(54 * tile / 96.0)), false);
    ASSERT_EQ(p.width, grid.width(2));
    ASSERT_EQ(p.height, rows.height(2));
    for (int y = 0; y < p.height; ++y)
      for (const int x : {0, grid.px(24) - 3, p.width - grid.px(24) + 3, p.width - 1})
        ASSERT_EQ(p.at(x, y), white) << x << " " << y << " in " << tile;
    // Every plane has one value, so each tile holds one colour; above its frame is a row without text.
    for (int i = 0; i < 4; ++i) {
      const int left = rows.left(i % 2), top = rows.top(i / 2);
      for (int x = 0; x < shown_width; ++x)
        ASSERT_EQ(p.at(left + x, top - 2), white) << i << ": " << x << " in " << tile;
      for (int x = 0; x < shown_width; ++x)
        for (const int y : {0, 1, 2, 3, rows.image_height - 2, rows.image_height - 1})
          ASSERT_EQ(p.at(left + x, top + y), p.at(left, top)) << i << ": " << x << " " << y << " in " << tile;
    }
  }
}

/// Unusual values that a file may hold.
const std::vector<Pattern> odd_values{level(0),
                                      level(1),
                                      level(-3),
                                      level(nan),
                                      level(inf),
                                      level(-inf),
                                      level(1e38f),
                                      level(1e-40f),
                                      [](int x, int y) {
                                        return (x + y) % 3 == 0 ? nan : (x + y) % 3 == 1 ? inf : float(x - y);
                                      },
                                      [](int x, int y) { return (x + y) % 2 == 0 ? -3e38f : 3e38f; }};

TEST_F(ContactSheetTest, EveryKindOfPlaneIsDrawnWhateverItHolds) {
  for (const Pattern& values : odd_values) {
    std::vector<Plane> planes;
    for (const PlaneKind& kind : plane_kinds())
      planes.push_back(patterned_plane(kind.name, 5, 3, std::vector<Pattern>(kind.components.size(), values)));
    planes.push_back(patterned_plane("peel.00", 5, 3, {values}));
    planes.push_back(patterned_plane("unheard of", 5, 3, {values, values}));
    const size_t count = planes.size();
    const Picture p = sheet(frame_of(std::move(planes)), {"odd", 100});
    const Grid grid(100, 60, true);
    EXPECT_EQ(p.width, grid.width(4));
    EXPECT_EQ(p.height, grid.height(int(count + 3) / 4));
  }
}

TEST_F(ContactSheetTest, PlanesWithAnotherNumberOfComponentsThanTheirKindAreDrawn) {
  for (const PlaneKind& kind : plane_kinds())
    for (const size_t components : {1, 2, 3, 4, 5})
      EXPECT_GT(
          sheet(frame_with(patterned_plane(kind.name, 4, 4, std::vector<Pattern>(components, level(0.3f))))).width, 480)
          << kind.name << " " << components;
}

TEST_F(ContactSheetTest, FramesOfEverySizeAreReadable) {
  for (const auto& [w, h] : std::vector<std::pair<int, int>>{{1, 1}, {1, 16384}, {16384, 1}, {3, 700}, {700, 3}}) {
    const Picture p = sheet(frame_with(patterned_plane("depth", w, h, {[](int x, int y) { return float(x + y + 1); }}),
                                       patterned_plane("ao", w, h, {level(0.5f)})));
    EXPECT_EQ(p.width, Grid(480, 0, true).width(2)) << w << "x" << h;
    EXPECT_LE(p.height, 1200) << w << "x" << h;
    EXPECT_EQ(p.at(0, 0), white);
  }
}

TEST_F(ContactSheetTest, ColoursAreRoundedOnRequest) {
  const Frame frame = frame_with(small("ao", {[](int x, int) { return float(x) / 95; }}));
  const auto levels = [&](int step) {
    const Picture p = sheet(frame, {"a", 480, 0, 4, step});
    std::set<int> found;
    for (const unsigned char v : p.rgb) found.insert(v);
    EXPECT_EQ(p.at(0, 0), white);
    for (const int v : found) EXPECT_TRUE(v % step == 0 || v == 255) << v;
    return found.size();
  };
  EXPECT_GT(levels(1), 95u);
  EXPECT_LE(levels(8), 33u);
}

TEST_F(ContactSheetTest, PositionsFarAwayDoNotWashOutTheRest) {
  const Pattern across = [](int x, int) { return x < 2 ? -1e4f : float(x) / 96; };
  const Picture p = sheet(frame_with(small("position", {across, level(0), level(0)})));
  const Grid grid(480, 270, false);
  EXPECT_LT(p.at(grid.left(0) + 60, grid.top(0) + 100).r, 60);
  EXPECT_NEAR(p.at(grid.left(0) + 240, grid.top(0) + 100).r, 128, 20);
  EXPECT_GT(p.at(grid.left(0) + 420, grid.top(0) + 100).r, 200);
}

TEST_F(ContactSheetTest, SaysWhatCannotBeDrawn) {
  const auto refuses = [&](const Frame& frame, const ContactSheet& options) {
    EXPECT_THROW(write_contact_sheet(folder / "x.png", frame, options), Error);
  };
  Frame frame = frame_with(small("ao", {level(0)}));
  refuses(frame, {"a", 63});
  refuses(frame, {"a", 5000});
  EXPECT_THROW(write_contact_sheet(folder / "missing" / "x.png", frame, {"a"}), Error);
  frame.views[0].planes["depth"] = patterned_plane("depth", 4, 4, {level(1)});
  refuses(frame, {"a"});
  frame.views[0].planes.clear();
  refuses(frame, {"a"});
  frame.views[0].planes["ao"] = Plane{"ao", {}};
  refuses(frame, {"a"});
  refuses(Frame{}, {"a"});
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace gloam::contact_sheet_test
