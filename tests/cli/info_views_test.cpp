// gloam info --sheet and --scan-line: one plane of all views as a picture.
#include "cli/gloam_process.h"
#include "unit/pictures.h"

namespace gloam::test::info_views_test {
namespace {

/// Three views of 96 x 54 pixels; `ao` is 1/4, 2/4 and 3/4 in them, and the row's number over 255 in the first ten columns.
Frame three_views() {
  Frame frame = small_frame(96, 54, {"depth", "color", "ao"});
  for (const char* name : {"left", "middle", "right"}) {
    const size_t i = frame.views.size() - 1;
    View& view = frame.views[i];
    view.name = name;
    view.planes["ao"] =
        patterned_plane("ao", 96, 54, {[&](int x, int y) { return x < 10 ? float(y) / 255 : float(i + 1) / 4; }});
    view.planes["color"] = patterned_plane("color", 96, 54, {level(1), level(0), level(0)});
    if (i == 2) break;
    View next;
    next.camera = view.camera;
    next.planes["depth"] = view.planes["depth"].clone();
    frame.views.push_back(std::move(next));
  }
  return frame;
}

class InfoViews : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_frame(path("views.exr"), three_views());
  }
  Result info(const Arguments& arguments) const {
    Arguments all = {"info", path("views.exr")};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return gloam(all);
  }
  void expect_refused(const Arguments& arguments, int status, const std::vector<std::string>& words) const {
    const Result result = info(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(result.out, "");
    for (const std::string& word : words) EXPECT_NE(result.err.find(word), std::string::npos) << result.err << word;
    EXPECT_EQ(files(), std::vector<std::string>{"views.exr"});
  }
};

/// Position of the first run of ten pixels of a colour; (-1, -1) if there is none.
std::pair<int, int> find_run(const Picture& picture, const Pixel& colour) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0, run = 0; x < picture.width; ++x) {
      run = picture.at(x, y) == colour ? run + 1 : 0;
      if (run == 10) return {x - 9, y};
    }
  return {-1, -1};
}

const std::pair<int, int> nowhere{-1, -1};
const std::vector<Pixel> greys{{64, 64, 64}, {128, 128, 128}, {191, 191, 191}};
const Pixel red{255, 0, 0};

TEST_F(InfoViews, SheetShowsTheFirstResultOfAllViews) {
  const Result result = info({"--sheet", path("sheet.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "wrote " + path("sheet.png").string() + "\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(files(), (std::vector<std::string>{"sheet.png", "views.exr"}));
  const Picture p = picture_in(path("sheet.png"));
  std::vector<std::pair<int, int>> places;
  for (const Pixel& grey : greys) places.push_back(find_run(p, grey));
  EXPECT_GT(places[1].first, places[0].first + 480);  // two columns
  EXPECT_EQ(places[1].second, places[0].second);
  EXPECT_EQ(places[2].first, places[0].first);
  EXPECT_GT(places[2].second, places[0].second + 270);
  EXPECT_EQ(find_run(p, red), nowhere);
}

TEST_F(InfoViews, WhatNamesThePlane) {
  ASSERT_EQ(info({"--sheet", path("sheet.png"), "--scan-line", path("line.png"), "--what", "color"}).status, 0);
  for (const char* name : {"sheet.png", "line.png"}) {
    const Picture p = picture_in(path(name));
    EXPECT_NE(find_run(p, red), nowhere) << name;
    for (const Pixel& grey : greys) EXPECT_EQ(find_run(p, grey), nowhere) << name;
  }
}

TEST_F(InfoViews, ScanLineShowsTheMiddleRowOrTheOneAskedFor) {
  const auto shows_row = [&](const Arguments& arguments, int row) {
    Arguments all = {"--scan-line", path("line.png")};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = info(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return find_run(picture_in(path("line.png")), {row, row, row}) != nowhere;
  };
  EXPECT_TRUE(shows_row({}, 27));
  EXPECT_FALSE(shows_row({}, 26));
  EXPECT_TRUE(shows_row({"--row", "0"}, 0));
  EXPECT_TRUE(shows_row({"--row", "53"}, 53));
  const Picture p = picture_in(path("line.png"));
  int above = 0;
  for (const Pixel& grey : greys) {
    EXPECT_GT(find_run(p, grey).second, above);
    above = find_run(p, grey).second + 100;  // three lines of 107
  }
}

TEST_F(InfoViews, ViewsAreThoseSelectedInTheirOrder) {
  ASSERT_EQ(info({"--scan-line", path("line.png"), "--views", "right,left"}).status, 0);
  const Picture p = picture_in(path("line.png"));
  EXPECT_EQ(find_run(p, greys[1]), nowhere);
  EXPECT_EQ(find_run(p, greys[0]).second, find_run(p, greys[2]).second + 160);
  ASSERT_EQ(info({"--sheet", path("sheet.png"), "--view", "middle"}).status, 0);
  const Picture one = picture_in(path("sheet.png"));
  EXPECT_NE(find_run(one, greys[1]), nowhere);
  EXPECT_EQ(find_run(one, greys[0]), nowhere);
}

TEST_F(InfoViews, FramesOfOneViewAreDrawnToo) {
  const Result result = gloam({"info", loggia, "--sheet", path("sheet.png"), "--scan-line", path("line.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "wrote " + path("sheet.png").string() + "\nwrote " + path("line.png").string() + "\n");
}

TEST_F(InfoViews, InputsAreTakenWhereThereIsNoResult) {
  write_frame(path("inputs.exr"), small_frame(96, 54, {"depth", "color", "normal"}));
  ASSERT_EQ(gloam({"info", path("inputs.exr"), "--sheet", path("sheet.png")}).status, 0);
  EXPECT_NE(find_run(picture_in(path("sheet.png")), {188, 188, 188}), nowhere);  // half the light, through sRGB
}

TEST_F(InfoViews, StandBesideTheOtherForms) {
  const Result plain = info({}), json = info({"--json", "-"});
  const Result with_json = info({"--json", "-", "--sheet", path("sheet.png")});
  EXPECT_EQ(with_json.out, json.out);
  const Result with_picture = info({"--picture", path("planes.png"), "--scan-line", path("line.png")});
  EXPECT_EQ(with_picture.out,
            plain.out + "wrote " + path("line.png").string() + "\nwrote " + path("planes.png").string() + "\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"line.png", "planes.png", "sheet.png", "views.exr"}));
}

TEST_F(InfoViews, SayInOneLineWhatCannotBeDrawn) {
  const std::string sheet = path("sheet.png"), line = path("line.png");
  expect_refused({"--sheet", path("sheet.jpg")}, 2, {"--sheet", "sheet.jpg", "name it with .png"});
  expect_refused({"--scan-line", path("line.exr")}, 2, {"--scan-line", "name it with .png"});
  expect_refused({"--sheet", sheet, "--what", "colour"}, 1,
                 {"--what colour", "did you mean 'color'?", "depth, color, ao"});
  expect_refused({"--sheet", sheet, "--what", "albedo"}, 1, {"--what albedo", "depth, color, ao"});
  expect_refused({"--scan-line", line, "--row", "54"}, 2, {"--row 54", "0 to 53"});
  expect_refused({"--scan-line", line, "--row=-1"}, 2, {"--row -1", "a whole number from 0 to"});
  expect_refused({"--scan-line", line, "--row", "middle"}, 2, {"--row middle", "a whole number from 0 to"});
  expect_refused({"--row", "5"}, 2, {"--row 5", "--scan-line"});
  expect_refused({"--sheet", sheet, "--row", "5"}, 2, {"--row 5", "--scan-line"});
  expect_refused({"--what", "ao"}, 2, {"--what ao", "--sheet"});
  expect_refused({"--sheet", sheet, "--scan-line", sheet}, 2, {"--scan-line", "--sheet"});
  expect_refused({"--sheet", path("missing/x.png")}, 1, {"--sheet", "missing"});
  expect_refused({"--sheet", sheet, "--views", "left,top"}, 1, {"top", "'middle'"});
}

TEST_F(InfoViews, APlaneThatSomeViewLacksIsNamed) {
  Frame frame = three_views();
  frame.views[1].planes.erase("ao");
  write_frame(path("views.exr"), frame);
  expect_refused({"--sheet", path("x.png"), "--what", "ao"}, 1, {"--what ao", "view 'middle' has no ao", "--views"});
  ASSERT_EQ(info({"--sheet", path("x.png")}).status, 0);
  EXPECT_NE(find_run(picture_in(path("x.png")), red), nowhere);
}

TEST_F(InfoViews, FilesWithoutAKnownPlaneAreRefused) {
  write_frame(path("views.exr"), small_frame(8, 8, {"something_else"}));
  expect_refused({"--sheet", path("x.png")}, 1, {"no plane that gloam knows", "something_else"});
  expect_refused({"--scan-line", path("x.png"), "--what", "ao"}, 1, {"--what ao", "something_else"});
}

}  // namespace
}  // namespace gloam::test::info_views_test
