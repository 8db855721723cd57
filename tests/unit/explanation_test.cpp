// The picture of gloam auto: its panels, its tint, its sizes.
#include "gloam/explanation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "gloam/error.h"
#include "unit/message_of.h"
#include "unit/pictures.h"

namespace gloam::explanation_test {
namespace {

using namespace test;
using Wanted = Explanation::Wanted;
constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

const Pixel white{255, 255, 255}, line_between{200, 200, 200}, green{0, 137, 0}, tone{214, 214, 214},
    line{186, 186, 186};
const std::string sentence =
    "something rises over the surface within the radius on 85 % of the image, so a mask would cost more than it saves";

/// One colour all over; no surface where `depth` is infinite.
View view_of(int width, int height, const Pattern& depth = level(2)) {
  View view;
  view.planes["depth"] = patterned_plane("depth", width, height, {depth});
  view.planes["color"] = patterned_plane("color", width, height, {level(0), level(0.25f), level(0)});
  return view;
}

Explanation effect_with(const Plane* cells, const std::string& name = "ambient occlusion") {
  return {.effect = name,
          .technique = "evidence, medium",
          .wanted = Wanted::yes,
          .where = "34 %",
          .why = sentence,
          .saved = "3.2 of 8.1 ms",
          .lost = ".0021 RMSE of the picture",
          .cells = cells};
}

struct Corner {
  int x, y;
};

/// Left top corners of the panels, by the thin frames around them.
std::vector<Corner> panels_in(const Picture& p, int width, int height) {
  const auto is_rule = [&](int x, int y) { return p.at(x, y) == line_between; };
  const auto is_side = [&](int x, int y) {
    for (int i = 0; i < height + 2; ++i)
      if (!is_rule(x, y + i)) return false;
    return true;
  };
  std::vector<Corner> corners;
  for (int y = 0; y + height + 1 < p.height; ++y)
    for (int x = 1; x + width + 1 < p.width - 1; ++x)
      if (is_rule(x, y) && is_rule(x + width + 1, y) && is_rule(x, y + height + 1) && p.at(x - 1, y) == white &&
          p.at(x + width + 2, y) == white && is_side(x, y) && is_side(x + width + 1, y))
        corners.push_back({x + 1, y + 1});
  return corners;
}

class ExplanationTest : public PictureTest {
 protected:
  Picture explained(const View& view, const std::vector<Explanation>& effects,
                    const ExplanationText& text = {"frame.exr", "all in all"}) {
    write_explanation(folder / "why.png", view, effects, text);
    return picture_in(folder / "why.png");
  }
};

TEST_F(ExplanationTest, EachEffectHasAPanelUnlessItIsImpossible) {
  const View view = view_of(480, 270);
  const Plane cells = patterned_plane("cells", 60, 34, {level(1)});
  std::vector<Explanation> effects;
  size_t panels = 1;  // the frame's colour
  for (int i = 0; i < 8; ++i) {
    effects.push_back(effect_with(&cells, fmt::format("effect {}", i)));
    effects.back().wanted = std::array{Wanted::yes, Wanted::no, Wanted::impossible}[size_t(i) % 3];
    if (i % 3 != 2) ++panels;
    EXPECT_EQ(panels_in(explained(view, effects), 480, 270).size(), panels) << i;
  }
  EXPECT_EQ(panels_in(explained(view, {}), 480, 270).size(), 1u);
  // What is not wanted and was not looked for has nothing to show.
  effects = {effect_with(nullptr)};
  effects[0].wanted = Wanted::no;
  const int height = explained(view, {}).height;
  EXPECT_EQ(panels_in(explained(view, effects), 480, 270).size(), 1u);
  EXPECT_GT(explained(view, effects).height, height);  // a row of the table
}

/// Expects the tint on the surfaces where `is_called_for` says so.
void expect_tint(const Picture& p, const Corner& corner, int width, int height,
                 const std::function<bool(int, int)>& is_surface, const std::function<bool(int, int)>& is_called_for) {
  std::optional<Pixel> pale, tint;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Pixel pixel = p.at(corner.x + x, corner.y + y);
      if (!is_surface(x, y)) {
        if (!(pixel == tone || pixel == line)) FAIL() << x << " " << y << ": " << pixel;
        continue;
      }
      std::optional<Pixel>& expected = is_called_for(x, y) ? tint : pale;
      if (!expected) expected = pixel;
      if (!(pixel == *expected)) FAIL() << x << " " << y << ": " << pixel << ", not " << *expected;
    }
  if (pale) {
    EXPECT_EQ(pale->r, pale->b);
    EXPECT_GE(pale->r, 140);
  }
  if (tint) {
    EXPECT_GT(tint->b, tint->r + 80);
  }
}

TEST_F(ExplanationTest, TheTintIsWhereTheCellsAreAboveZeroAndNowhereElse) {
  const auto is_above_0 = [](int tile_x, int tile_y) { return (tile_x * 7 + tile_y * 3) % 5 < 2; };
  const auto is_surface = [](int x, int y) { return x < 400 || y > 100; };
  // The last tile of a row is cut, with 64 by more than the others share.
  for (const int side : {1, 4, 8, 64}) {
    constexpr int width = 489, height = 275;
    const View view = view_of(width, height, [&](int x, int y) { return is_surface(x, y) ? 2 : inf; });
    const Layout tiles = reduced(Layout(width, height), side);
    const Plane cells = patterned_plane("cells", tiles.width, tiles.height, {[&](int x, int y) {
                                          return is_above_0(x, y) ? 0.01f : x % 2 ? 0 : nan;
                                        }});
    Explanation everywhere = effect_with(nullptr, "reflections");
    everywhere.is_everywhere = true;
    const Picture p = explained(view, {effect_with(&cells), everywhere});
    const std::vector<Corner> panels = panels_in(p, width, height);
    ASSERT_EQ(panels.size(), 3u);
    EXPECT_EQ(p.at(panels[0].x + 450, panels[0].y + 50), green);  // the sky keeps its colour
    expect_tint(p, panels[1], width, height, is_surface, [&](int x, int y) { return is_above_0(x / side, y / side); });
    expect_tint(p, panels[2], width, height, is_surface, [](int, int) { return true; });
  }
}

TEST_F(ExplanationTest, TheTintIsStrongerWhereThePictureChangesMore) {
  const View view = view_of(480, 272);
  const Plane cells = patterned_plane("cells", 60, 34, {[](int, int y) { return y < 30; }});
  const Plane ramp = patterned_plane("change", 60, 34, {[](int x, int) { return float(x) * 0.01f; }});
  const Plane small = patterned_plane("change", 60, 34, {level(0.1f)}),
              odd = patterned_plane("change", 60, 34, {[](int x, int) { return x < 20   ? nan
                                                                               : x < 40 ? inf
                                                                                        : -1; }});
  std::vector<Explanation> effects;
  for (const Plane* change : {&ramp, &small, &odd}) {
    effects.push_back(effect_with(&cells));
    effects.back().change = change;
  }
  const Picture p = explained(view, effects);
  const std::vector<Corner> panels = panels_in(p, 480, 272);
  ASSERT_EQ(panels.size(), 4u);
  const auto red = [&](size_t panel, int tile_x, int tile_y = 5) {
    return p.at(panels[panel].x + 8 * tile_x + 4, panels[panel].y + 8 * tile_y + 4).r;
  };
  const int pale = red(1, 20, 32);
  EXPECT_LT(red(1, 0), pale - 10);  // called for, however little it changes
  for (int x = 1; x < 55; ++x) EXPECT_LT(red(1, x), red(1, x - 1)) << x;
  EXPECT_EQ(red(2, 30), red(1, 10));  // one scale for all effects
  EXPECT_EQ(red(3, 10), red(1, 0));
  EXPECT_EQ(red(3, 30), red(1, 59));
  EXPECT_EQ(red(3, 50), red(1, 0));
  EXPECT_EQ(red(1, 59, 32), pale);
}

TEST_F(ExplanationTest, AnEffectHasARowWithThePictureWithoutItAndWithIt) {
  const View view = view_of(480, 270);
  const Pixel dark{0, 71, 0}, red{137, 0, 0};
  const auto of = [](float r, float g) { return patterned_plane("color", 160, 90, {level(r), level(g), level(0)}); };
  const PicturePart part{
      .left = 0.5, .top = 0.25, .width = 1 / 3.0, .height = 1 / 3.0, .without = of(0.25f, 0), .with = of(0, 0.0625f)};
  Explanation computed = effect_with(nullptr), missing = effect_with(nullptr);
  computed.is_everywhere = missing.is_everywhere = true;
  computed.part = &part;
  const Plane picture = patterned_plane("color", 480, 270, {level(0), level(0.0625f), level(0)});
  write_explanation(folder / "why.png", view, {computed, missing}, {.title = "frame.exr", .picture = &picture});
  const Picture p = picture_in(folder / "why.png");
  const std::vector<Corner> panels = panels_in(p, 480, 270);
  ASSERT_EQ(panels.size(), 6u);  // the colour and the picture; three of the first effect; one of the other
  const auto middle = [&](size_t panel) { return p.at(panels[panel].x + 5, panels[panel].y + 5); };
  EXPECT_EQ(middle(0), green);
  EXPECT_EQ(middle(1), dark);
  EXPECT_EQ(middle(3), red);
  EXPECT_EQ(middle(4), dark);
  EXPECT_EQ(panels[2].y, panels[4].y);
  EXPECT_GT(panels[5].y, panels[4].y);
  // The part is outlined in the effect's own panel, and in no other.
  const Pixel vermilion{213, 94, 0};
  for (size_t panel = 0; panel < panels.size(); ++panel) {
    const Corner& corner = panels[panel];
    EXPECT_EQ(p.at(corner.x + 240, corner.y + 100) == vermilion, panel == 2) << panel;
    EXPECT_EQ(p.at(corner.x + 300, corner.y + 68) == vermilion, panel == 2) << panel;
  }
}

TEST_F(ExplanationTest, SheetsFitAScreenWhateverTheImageAndTheNumberOfEffects) {
  Explanation everywhere = effect_with(nullptr);
  everywhere.is_everywhere = true;
  const Picture plain = explained(view_of(480, 270), {everywhere});
  const Corner panel = panels_in(plain, 480, 270).at(1);
  const Pixel tint = plain.at(panel.x, panel.y);
  for (const auto& [w, h] :
       std::vector<std::pair<int, int>>{{1, 1}, {64, 256}, {256, 64}, {3000, 20}, {350, 950}, {960, 540}}) {
    const View view = view_of(w, h);
    for (const size_t count : {0, 1, 6, 8}) {
      const Picture p = explained(view, std::vector<Explanation>(count, everywhere));
      EXPECT_LE(p.width, 2000) << w << "x" << h << " " << count;
      EXPECT_GE(p.width, 1000) << w << "x" << h << " " << count;
      // No panel is hidden: each effect has as much tint as the first panel has green.
      size_t greens = 0, tints = 0;
      for (size_t i = 0; i < p.rgb.size(); i += 3) {
        const auto is = [&](const Pixel& c) { return p.rgb[i] == c.r && p.rgb[i + 1] == c.g && p.rgb[i + 2] == c.b; };
        greens += is(green);
        tints += is(tint);
      }
      EXPECT_GE(greens, 24u * 24u) << w << "x" << h << " " << count;
      EXPECT_EQ(tints, count * greens) << w << "x" << h << " " << count;
    }
  }
}

TEST_F(ExplanationTest, ThePanelsOfCommonSizesAreSharp) {
  for (const auto& [w, h, shown_w, shown_h] : std::vector<std::array<int, 4>>{{960, 540, 960, 540},
                                                                              {1920, 1080, 960, 540},

                                                                              {200, 120, 400, 240},
                                                                              {64, 256, 128, 512}}) {
    const View view = view_of(w, h);
    Explanation everywhere = effect_with(nullptr);
    everywhere.is_everywhere = true;
    EXPECT_EQ(panels_in(explained(view, {everywhere, everywhere}), shown_w, shown_h).size(), 3u) << w << "x" << h;
  }
}

TEST_F(ExplanationTest, TextStaysInsideTheMarginAndOffThePanels) {
  const View view = view_of(480, 270);
  const Plane cells = patterned_plane("cells", 60, 34, {level(0)});
  Explanation effect = effect_with(&cells, std::string(300, 'W') + " " + sentence);
  effect.technique = effect.saved = effect.lost = effect.where = sentence + " " + std::string(200, 'M');
  effect.why = sentence + sentence + sentence + std::string("\n\xff\x80");
  const Picture p =
      explained(view, {effect, effect, effect_with(&cells)}, {std::string(5000, 'W'), sentence + sentence});
  ASSERT_LE(p.width, 2000);
  for (int y = 0; y < p.height; ++y)
    for (const int x : {0, 10, 16, p.width - 16, p.width - 10, p.width - 1})
      ASSERT_EQ(p.at(x, y), white) << x << " " << y;
  for (int x = 0; x < p.width; ++x)
    for (const int y : {0, 10, p.height - 10, p.height - 1}) ASSERT_EQ(p.at(x, y), white) << x << " " << y;
  const std::vector<Corner> panels = panels_in(p, 480, 270);
  ASSERT_EQ(panels.size(), 4u);
  for (size_t i = 1; i < panels.size(); ++i)
    expect_tint(
        p, panels[i], 480, 270, [](int, int) { return true; }, [](int, int) { return false; });
}

TEST_F(ExplanationTest, AViewWithoutColourIsLitFromTheEye) {
  View view = view_of(480, 270);
  view.planes.erase("color");
  view.planes["normal"] = patterned_plane("normal", 480, 270, {level(0), level(0.6f), level(0.8f)});
  const Picture p = explained(view, {});
  const std::vector<Corner> panels = panels_in(p, 480, 270);
  ASSERT_EQ(panels.size(), 1u);
  const Pixel lit = p.at(panels[0].x + 100, panels[0].y + 100);
  EXPECT_NEAR(lit.r, (0.25 + 0.7 * 0.8) * 255, 1);
  EXPECT_EQ(lit.r, lit.b);
}

TEST_F(ExplanationTest, SaysWhatItCannotExplain) {
  View view = view_of(48, 27);
  view.planes.erase("depth");
  EXPECT_NE(message_of([&] { write_explanation(folder / "why.png", view, {}); }).find("without depth"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace gloam::explanation_test
