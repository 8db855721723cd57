// Pictures of one plane in many views: positions and scales.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "gloam/error.h"
#include "gloam/visualise.h"
#include "unit/message_of.h"
#include "unit/pictures.h"

namespace gloam::view_pictures_test {
namespace {

using namespace test;
constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

const Pixel white{255, 255, 255}, black{0, 0, 0}, tone{214, 214, 214}, line{186, 186, 186}, magenta{255, 0, 255};

/// A view's value at a pixel.
using ViewPattern = std::function<float(int view, int x, int y)>;

/// Views module00, module01, ... with a plane of one component.
Frame frame_of(int views, int width, int height, const std::string& plane, const ViewPattern& values) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  for (int i = 0; i < views; ++i) {
    View& view = frame.views.emplace_back();
    view.name = fmt::format("module{:02}", i);
    view.planes[plane] = patterned_plane(plane, width, height, {[&](int x, int y) { return values(i, x, y); }});
  }
  return frame;
}

void add_plane(Frame& frame, const std::string& plane, const ViewPattern& values) {
  for (int i = 0; i < int(frame.views.size()); ++i)
    frame.views[size_t(i)].planes[plane] =
        patterned_plane(plane, frame.width(), frame.height(), {[&](int x, int y) { return values(i, x, y); }});
}

/// Bounding box; ends exclusive.
struct Box {
  int left = 1 << 30, top = 1 << 30, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

template <typename Wanted>
Box box_where(const Picture& picture, const Wanted& wanted) {
  Box box;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (wanted(x, y))
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), std::max(box.bottom, y + 1)};
  return box;
}

/// Bounding box of horizontal runs of a colour; the soft edges of text have no such runs.
Box box_of(const Picture& picture, const Pixel& colour, int shortest = 6) {
  Box box;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0, run = 0; x < picture.width; ++x) {
      run = picture.at(x, y) == colour ? run + 1 : 0;
      if (run < shortest) continue;
      box = {std::min(box.left, x + 1 - run), std::min(box.top, y), std::max(box.right, x + 1),
             std::max(box.bottom, y + 1)};
    }
  return box;
}

class ViewPicturesTest : public PictureTest {
 protected:
  Picture sheet(const Frame& frame, const std::string& plane, const std::string& title = "a.exr") {
    write_view_sheet(folder / "sheet.png", frame, {title, plane});
    return picture_in(folder / "sheet.png");
  }
  Picture lines(const Frame& frame, const std::string& plane, int row, const std::string& title = "a.exr") {
    write_scan_lines(folder / "lines.png", frame, {title, plane, row});
    return picture_in(folder / "lines.png");
  }
};

/// Views of one colour each, which no text and no paper has, by which they are found.
Frame coloured_views(int views, int width, int height) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  for (int i = 0; i < views; ++i) {
    View& view = frame.views.emplace_back();
    view.name = fmt::format("module{:02}", i);
    view.planes["normal"] =
        patterned_plane("normal", width, height, {level(1), level(float(i % 16) / 16), level(-float(i / 16) / 16)});
  }
  return frame;
}

Pixel colour_of(int view) {
  const auto byte = [](double v) { return int(std::lrint((0.5 + 0.5 * v) * 255)); };
  return {255, byte(view % 16 / 16.0), byte(-(view / 16) / 16.0)};
}

// ---------------------------------------------------------------------------------------------------------------------
// Sheets

TEST_F(ViewPicturesTest, SheetHasATileForEachViewInRows) {
  const Picture p = sheet(coloured_views(6, 96, 54), "normal");
  std::vector<Box> boxes;
  for (int i = 0; i < 6; ++i) {
    boxes.push_back(box_of(p, colour_of(i)));
    EXPECT_EQ(boxes[size_t(i)].width(), 480) << i;  // five times as large
    EXPECT_EQ(boxes[size_t(i)].height(), 270) << i;
  }
  for (size_t i : {0, 1, 2}) {
    EXPECT_EQ(boxes[i].top, boxes[0].top);
    EXPECT_EQ(boxes[i + 3].left, boxes[i].left);
    EXPECT_EQ(boxes[i + 3].top, boxes[3].top);
    EXPECT_GT(boxes[i].left, i == 0 ? 0 : boxes[i - 1].right);
  }
  EXPECT_GT(boxes[3].top, boxes[0].bottom + 10);  // a name between
  EXPECT_EQ(p.width, boxes[2].right + boxes[0].left);
}

TEST_F(ViewPicturesTest, SheetsAreNoWiderThanAScreenShows) {
  const auto width_of = [&](int views, int width, int height) {
    return sheet(coloured_views(views, width, height), "normal").width;
  };
  EXPECT_LE(width_of(1, 3000, 20), 2400);
  EXPECT_LE(width_of(2, 2000, 40), 2400);
  EXPECT_LE(width_of(3, 1, 1), 2400);
  EXPECT_LE(width_of(12, 20, 900), 2400);
  EXPECT_LE(width_of(300, 40, 30), 2400);
  const Picture eighty = sheet(coloured_views(80, 256, 192), "normal");
  EXPECT_GT(eighty.width, 2300);
  EXPECT_LE(eighty.width, 2400);
  EXPECT_LE(eighty.height, 2000);
  const Box first = box_of(eighty, colour_of(0)), last = box_of(eighty, colour_of(79));
  EXPECT_EQ(first.width(), last.width());
  EXPECT_NEAR(double(first.width()) / first.height(), 4.0 / 3, 0.02);
  EXPECT_EQ(last.right + first.left, eighty.width);  // ten by eight leave no gap
}

TEST_F(ViewPicturesTest, OneViewIsASheetOfOneAtItsSize) {
  const Picture p = sheet(coloured_views(1, 700, 300), "normal");
  const Box box = box_of(p, colour_of(0));
  EXPECT_EQ(box.width(), 700);
  EXPECT_EQ(box.height(), 300);
}

TEST_F(ViewPicturesTest, ViewsShareOneScale) {
  const Picture scalars = sheet(frame_of(3, 96, 54, "zebra", [](int i, int, int) { return float(i); }), "zebra");
  EXPECT_EQ(box_of(scalars, {128, 128, 128}).width(), 480);  // the middle of 0 to 2, not of its own range
  const ViewPattern near_and_far = [](int i, int x, int) { return i == 0 ? 4.0f : x < 48 ? 4.0f : 16.0f; };
  const Picture depths = sheet(frame_of(2, 96, 54, "depth", near_and_far), "depth");
  const Box first = box_of(depths, {253, 231, 37});  // viridis, the near end: the left half of the second view too
  EXPECT_GT(first.width(), 480 + 240);
  EXPECT_LT(first.width(), 480 + 2 * 240);
}

TEST_F(ViewPicturesTest, BackgroundIsHatchedAndWhatIsNotFiniteStandsOut) {
  Frame frame = frame_of(2, 96, 54, "ao", [](int i, int x, int) { return i == 1 && x < 48 ? nan : 0.5f; });
  add_plane(frame, "depth", [](int i, int x, int) { return i == 0 && x < 48 ? inf : 2.0f; });
  const Picture p = sheet(frame, "ao");
  const Box odd = box_of(p, magenta), tones = box_of(p, tone);
  EXPECT_EQ(odd.width(), 240);
  EXPECT_EQ(odd.height(), 270);
  EXPECT_NEAR(tones.width(), 240, 2);
  EXPECT_EQ(tones.height(), 270);
  const int across = (tones.top + tones.bottom) / 2;
  std::set<int> seen;
  for (int x = tones.left; x < tones.right; ++x) seen.insert(p.at(x, across).r);
  EXPECT_EQ(seen, (std::set<int>{tone.r, line.r}));
  EXPECT_GT(odd.left, tones.right + 240);
}

TEST_F(ViewPicturesTest, NamesStandAboveTheirTiles) {
  Frame frame = coloured_views(6, 96, 54);
  const Picture before = sheet(frame, "normal");
  frame.views[4].name = "another";
  const Picture after = sheet(frame, "normal");
  ASSERT_EQ(before.width, after.width);
  const Box changed = box_where(before, [&](int x, int y) { return before.at(x, y) != after.at(x, y); });
  const Box tile = box_of(before, colour_of(4));
  EXPECT_GT(changed.width(), 40);
  EXPECT_GE(changed.left, tile.left - 2);
  EXPECT_LE(changed.right, tile.right);
  EXPECT_LT(changed.bottom, tile.top);
  EXPECT_GT(changed.top, tile.top - 45);
}

TEST_F(ViewPicturesTest, LongAndOddNamesStayInTheirPlaces) {
  Frame frame = coloured_views(4, 96, 54);
  const std::vector<std::string> names{std::string(3000, 'W'), "\n\xff\x80", "", "\xc3\xa9t\xc3\xa9"};
  for (size_t i = 0; i < 4; ++i) frame.views[i].name = names[i];
  const Picture p = sheet(frame, "normal", std::string(5000, 'W'));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(box_of(p, colour_of(i)).width(), 480) << i;
  for (int y = 0; y < p.height; ++y)
    for (const int x : {0, 20, p.width - 21, p.width - 1}) ASSERT_EQ(p.at(x, y), white) << x << " " << y;
  const Picture l = lines(frame, "normal", 3, std::string(5000, 'W'));
  for (int y = 0; y < l.height; ++y)
    for (const int x : {0, 20, l.width - 2, l.width - 1}) ASSERT_EQ(l.at(x, y), white) << x << " " << y;
}

// ---------------------------------------------------------------------------------------------------------------------
// Scan lines

/// A bright column that moves by `step` pixels from view to view, like a surface across neighbouring views.
Frame moving_column(int views, int start, int step) {
  return frame_of(views, 96, 54, "ao", [=](int i, int x, int) { return x == start + step * i ? 0.75f : 0.25f; });
}

TEST_F(ViewPicturesTest, ScanLinesFollowASurfaceFromViewToView) {
  const Picture p = lines(moving_column(8, 10, 3), "ao", 20);
  const Pixel dark{64, 64, 64}, bright{191, 191, 191};
  const Box all = box_of(p, dark);
  EXPECT_EQ(all.width(), 960);   // ten times as wide
  EXPECT_EQ(all.height(), 320);  // eight lines of 40
  for (int i = 0; i < 8; ++i)
    for (const int y : {0, 20, 39})
      for (const int x : {0, 9})
        ASSERT_EQ(p.at(all.left + 10 * (10 + 3 * i) + x, all.top + 40 * i + y), bright) << i << ": " << x << " " << y;
  const Box moved = box_of(p, bright);
  EXPECT_EQ(moved.left, all.left + 100);
  EXPECT_EQ(moved.right, all.left + 10 * (10 + 3 * 7 + 1));
  EXPECT_EQ(moved.height(), 320);
}

TEST_F(ViewPicturesTest, LinesAreAsThickAsMakesThePictureVisible) {
  const auto height_of = [&](int views) {
    return box_of(lines(frame_of(views, 40, 3, "ao", [](int, int, int) { return 0.25f; }), "ao", 1), {64, 64, 64})
        .height();
  };
  EXPECT_EQ(height_of(1), 320);
  EXPECT_EQ(height_of(3), 3 * 107);
  EXPECT_EQ(height_of(80), 320);
  EXPECT_EQ(height_of(500), 500);
}

TEST_F(ViewPicturesTest, WideLinesAreReducedAndNoPictureIsWiderThanTheSheet) {
  const Picture p = lines(frame_of(3, 9000, 2, "ao", [](int, int, int) { return 0.25f; }), "ao", 1);
  EXPECT_LE(p.width, 2400);
  EXPECT_GT(p.width, 2000);
  EXPECT_EQ(box_of(p, {64, 64, 64}).height(), 3 * 107);
}

TEST_F(ViewPicturesTest, TheRowIsTheOneAskedFor) {
  const Frame frame = frame_of(4, 96, 54, "ao", [](int, int, int y) { return float(y) / 255; });
  for (const int row : {0, 1, 27, 53}) {
    const Picture p = lines(frame, "ao", row);
    EXPECT_EQ(box_of(p, {row, row, row}).width(), 960) << row;
  }
}

/// Data beyond the image: row 0 is the image's, and pixels beside it are drawn.
TEST_F(ViewPicturesTest, RowsCountFromTheTopOfTheDisplayWindow) {
  Frame frame = frame_of(4, 96, 54, "ao", [](int, int, int y) { return float(100 + y) / 255; });
  frame.display = {0, 0, 80, 40};
  frame.window = {-8, -5, 88, 49};
  EXPECT_EQ(box_of(lines(frame, "ao", 0), {105, 105, 105}).width(), 960);
  EXPECT_EQ(box_of(lines(frame, "ao", 39), {144, 144, 144}).width(), 960);
  EXPECT_THROW(lines(frame, "ao", 40), Error);
}

TEST_F(ViewPicturesTest, LinesShareOneScale) {
  // The row's own scale: values of other rows do not count.
  const Frame frame = frame_of(3, 96, 54, "zebra", [](int i, int, int y) { return y == 9 ? float(i) : 1e6f; });
  const Box middle = box_of(lines(frame, "zebra", 9), {128, 128, 128});
  EXPECT_EQ(middle.width(), 960);
  EXPECT_EQ(middle.height(), 107);
}

TEST_F(ViewPicturesTest, BackgroundOfALineIsThatOfItsView) {
  Frame frame = moving_column(8, 10, 3);
  add_plane(frame, "depth", [](int i, int x, int y) { return y == 20 && i == 3 && x < 50 ? inf : 2.0f; });
  const Picture p = lines(frame, "ao", 20);
  const Box hatched = box_of(p, tone);
  EXPECT_NEAR(hatched.width(), 500, 2);
  EXPECT_NEAR(hatched.height(), 40, 2);
  EXPECT_NEAR(hatched.top, box_of(p, {64, 64, 64}).top + 120, 2);
  EXPECT_EQ(box_of(lines(frame, "ao", 21), tone).width(), Box().width());
}

TEST_F(ViewPicturesTest, FirstAndLastNamesStandBesideTheirLines) {
  for (const int views : {2, 80}) {
    Frame frame = frame_of(views, 96, 54, "ao", [](int, int, int) { return 0.25f; });
    for (View& view : frame.views) view.name = "module";  // one width: none moves the others
    const Picture before = lines(frame, "ao", 20);
    const Box panel = box_of(before, {64, 64, 64});
    for (const int i : {0, views - 1}) {
      frame.views[size_t(i)].name = "m";
      const Picture after = lines(frame, "ao", 20);
      frame.views[size_t(i)].name = "module";
      ASSERT_EQ(before.width, after.width);
      const Box name = box_where(after, [&](int x, int y) {  // the heading names the first view too
        return y > panel.top - 10 && after.at(x, y) != before.at(x, y);
      });
      EXPECT_GT(name.width(), 20);
      EXPECT_LT(name.right, panel.left);
      EXPECT_NEAR((name.top + name.bottom) / 2.0, panel.top + panel.height() * (i + 0.5) / views, 4) << views << i;
    }
  }
}

TEST_F(ViewPicturesTest, LinesOfEveryKindOfPlaneAreDrawn) {
  for (const char* plane : {"depth", "instance", "peel_count", "ao", "alpha", "unheard of"})
    for (const float value : {0.0f, -1.0f, nan, inf, 1e38f, 1e-40f}) {
      const Frame frame = frame_of(3, 5, 4, plane, [=](int, int, int) { return value; });
      EXPECT_GT(lines(frame, plane, 2).width, 960) << plane << " " << value;
      EXPECT_GT(sheet(frame, plane).width, 480) << plane << " " << value;
    }
  for (const char* plane : {"motion", "position", "color", "normal", "reflection"}) {
    Frame frame = frame_of(3, 5, 4, "ao", [](int, int, int) { return 1.0f; });
    const size_t components = std::string(plane) == "motion" ? 2 : std::string(plane) == "reflection" ? 4 : 3;
    for (View& view : frame.views)
      view.planes[plane] = patterned_plane(plane, 5, 4, std::vector<Pattern>(components, level(0.3f)));
    EXPECT_GT(lines(frame, plane, 0).width, 960) << plane;
    EXPECT_GT(sheet(frame, plane).width, 480) << plane;
  }
}

TEST_F(ViewPicturesTest, SaysWhatCannotBeDrawn) {
  const auto refuses = [&](const Frame& frame, const std::string& plane, int row, const std::string& words) {
    if (row == 0) {
      const std::string message = message_of([&] { sheet(frame, plane); });
      EXPECT_NE(message.find(words), std::string::npos) << message;
    }
    const std::string message = message_of([&] { lines(frame, plane, row); });
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  Frame frame = frame_of(2, 8, 6, "ao", [](int, int, int) { return 1.0f; });
  refuses(frame, "ao", 6, "rows 0 to 5");
  refuses(frame, "ao", -1, "row -1");
  refuses(frame, "depth", 0, "view 'module00' has no 'depth'");
  frame.views[1].planes["ao"] = patterned_plane("ao", 8, 5, {level(1)});
  refuses(frame, "ao", 0, "'ao' is 8x5 and the frame 8x6");
  frame.views[1].planes["ao"] = patterned_plane("ao", 8, 6, {level(1), level(1)});
  refuses(frame, "ao", 0, "2 components in view 'module01'");
  frame.views[1].planes.clear();
  refuses(frame, "ao", 0, "view 'module01' has no 'ao'");
  refuses(Frame{}, "ao", 0, "no pixels");
  EXPECT_THROW(write_view_sheet(folder / "missing" / "x.png", coloured_views(2, 4, 4), {"a", "normal"}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace gloam::view_pictures_test
