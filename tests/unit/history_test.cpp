// The data that a run takes from the run on the frame before.
#include "gloam/history.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "gloam/error.h"
#include "gloam/frame_files.h"
#include "support/stress.h"
#include "unit/message_of.h"

namespace gloam::test::history_test {
namespace {

namespace fs = std::filesystem;

class HistoryTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-history-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }

  /// A view of a wall at depth 2 with sky in its first column; its reflection is `value`, but none in the last column.
  static View view_of(const std::string& name, float value, const Layout& layout, double eye_x) {
    View view;
    view.name = name;
    view.camera = perspective(layout.width, layout.height).camera;
    view.camera->pose = Pose();
    view.camera->pose->position.x = eye_x;
    const auto add = [&](const std::string& plane, size_t components, float all) {
      view.planes[plane].name = plane;
      for (size_t i = 0; i < components; ++i) view.planes[plane].channels.emplace_back(layout, all);
    };
    add("depth", 1, 2);
    add("reflection", 4, value);
    for (int y = 0; y < layout.height; ++y) {
      view.planes["depth"].channels[0].at(0, y) = std::numeric_limits<float>::infinity();
      for (Channel& channel : view.planes["reflection"].channels) channel.at(layout.width - 1, y) = 0;
    }
    return view;
  }

  static Frame frame_of(const std::vector<std::string>& names, int width = 8, int height = 4, int x0 = 0) {
    Frame frame;
    frame.display = frame.window = {x0, 0, x0 + width, height};
    for (size_t i = 0; i < names.size(); ++i)
      frame.views.push_back(view_of(names[i], 0.25f * float(i + 1), Layout(width, height), 0.1 * double(i)));
    return frame;
  }

  fs::path written(const Frame& frame) const {
    const fs::path path = folder / "before.exr";
    write_frame(path, frame, {});
    return path;
  }

  void take(const Frame& before, Frame& frame) const { History(written(before)).add_to(frame, history_planes()); }

  fs::path folder;
};

TEST_F(HistoryTest, EachViewHasItsOwn) {
  const Frame before = frame_of({"left", "right"});
  Frame frame = frame_of({"right", "left"});
  take(before, frame);
  for (const View& view : frame.views) {
    const float value = view.name == "left" ? 0.25f : 0.5f;
    const auto at = [&](const char* plane, int x) { return view.find(plane)->channels[0].at(x, 1); };
    EXPECT_EQ(view.find("history")->channels.size(), 4u);
    EXPECT_EQ(at("history", 3), value) << view.name;
    EXPECT_EQ(at("history_depth", 3), 2);
    // One frame, except for the sky and for pixels that reflect nothing.
    EXPECT_EQ(at("history_frames", 3), 1);
    EXPECT_EQ(at("history_frames", 0), 0);
    EXPECT_EQ(at("history_frames", 7), 0);
    ASSERT_TRUE(view.camera_before && view.camera_before->pose);
    EXPECT_NEAR(view.camera_before->pose->position.x, view.name == "left" ? 0 : 0.1, 1e-6);
    for (const char* plane : {"history", "history_depth", "history_frames"}) EXPECT_EQ(view.find(plane)->name, plane);
    EXPECT_EQ(view.find("history_ao"), nullptr);
  }
}

TEST_F(HistoryTest, AnUnnamedViewIsOfTheOnlyOne) {
  Frame frame = frame_of({"left"});
  take(frame_of({""}), frame);
  EXPECT_EQ(frame.views[0].find("history")->channels[0].at(3, 1), 0.25f);
}

TEST_F(HistoryTest, AnotherPartOfTheImageIsPlaced) {
  Frame before = frame_of({""}), frame = frame_of({""}, 8, 4, 2);
  before.display = frame.display = {0, 0, 16, 4};
  Channel& depth = before.views[0].planes.at("depth").channels[0];
  for (int x = 0; x < 8; ++x) depth.at(x, 1) = 10 + float(x);
  add_history(frame, std::move(before), history_planes(), "the frame before");
  const Channel& placed = frame.views[0].find("history_depth")->channels[0];
  EXPECT_EQ(placed.at(0, 1), 12);
  EXPECT_EQ(placed.at(5, 1), 17);
  EXPECT_TRUE(std::isinf(placed.at(6, 1))) << "the frame before did not show it";
}

TEST_F(HistoryTest, AViewWithoutResultsKnowsNothing) {
  Frame before = frame_of({"left"}), frame = frame_of({"left", "right"});
  add_history(frame, std::move(before), history_planes(), "the frame before");
  EXPECT_EQ(frame.views[0].find("history_depth")->channels[0].at(3, 1), 2);
  EXPECT_TRUE(std::isinf(frame.views[1].find("history_depth")->channels[0].at(3, 1)));
}

TEST_F(HistoryTest, AnotherEyeOrWindowIsRefused) {
  Frame frame = frame_of({"left"});
  EXPECT_NE(message_of([&] { take(frame_of({"right"}), frame); }).find("has no view 'left'"), std::string::npos);
  const std::string shifted = message_of([&] { take(frame_of({"left"}, 8, 4, 2), frame); });
  EXPECT_NE(shifted.find("shows 8x4 pixels from (2, 0), and the frame 8x4 pixels from (0, 0)"), std::string::npos)
      << shifted;
  Frame without = frame_of({"left"});
  without.views[0].planes.erase("reflection");
  const std::string missing = message_of([&] { take(without, frame); });
  EXPECT_NE(missing.find("has no 'reflection', 'ao_raw' or 'indirect_raw'; give the file that gloam run --temporal wrote"),
            std::string::npos)
      << missing;
}

}  // namespace
}  // namespace gloam::test::history_test
