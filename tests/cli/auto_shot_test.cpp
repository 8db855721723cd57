// gloam auto on a shot: each frame is decided by itself, at one radius, and what was decided is told.
#include "cli/shot_fixture.h"

namespace gloam::test::auto_shot_test {
namespace {

class AutoShot : public ShotTest {
 protected:
  /// Frames 1 and 2 have a step in a floor; frame 3 has nothing but background.
  void make_changing_shot() const {
    make_shot({1, 2});
    Frame empty = frame_of(3);
    Channel& depth = empty.views[0].planes.at("depth").channels[0];
    for (int y = 0; y < empty.height(); ++y) std::fill_n(depth.row(y), empty.width(), INFINITY);
    write_frame(path(numbered("shot", 3)), empty);
  }
  Result automatic(const Arguments& more = {}) const {
    Arguments all = {"auto", file("shot.####.exr"), "-o", file("out.####.exr")};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
};

TEST_F(AutoShot, EachFrameIsThatOfARunOnItAlone) {
  make_changing_shot();
  const Result result = automatic({"--radius", "0.5"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("ambient occlusion: wanted in 2 of 3 frames computed"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("not wanted in 3"), std::string::npos) << result.err;
  for (const int number : {1, 2, 3}) {
    ASSERT_EQ(gloam({"auto", file(numbered("shot", number)), "-o", file("one.exr"), "--radius", "0.5", "--mask",
                     "never", "--half"})
                  .status,
              0);
    FrameFile of_shot(path(numbered("out", number)), {.as_stored = true}), alone(path("one.exr"), {.as_stored = true});
    EXPECT_EQ(of_shot.all_channels(), (std::vector<std::string>{"AO", "Y"}));
    EXPECT_EQ(of_shot.planes()[0].channels[0].type, "half");
    EXPECT_TRUE(same_bits(of_shot.read({"ao"}), alone.read({"ao"}))) << number;
    EXPECT_EQ(of_shot.text_attribute("gloamParameters"), alone.text_attribute("gloamParameters"));
  }
}

TEST_F(AutoShot, OneRadiusForAllFrames) {
  make_shot({1, 2, 3});
  Frame far = frame_of(2);
  Channel& depth = far.views[0].planes.at("depth").channels[0];
  for (int y = 0; y < far.height(); ++y)
    for (int x = 0; x < far.width(); ++x) depth.at(x, y) *= 10;
  write_frame(path(numbered("shot", 2)), far);
  const Result result = automatic();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("radius: "), std::string::npos) << result.err;
  const auto parameters = [&](int frame) {
    return FrameFile(path(numbered("out", frame)), {}).text_attribute("gloamParameters");
  };
  EXPECT_NE(parameters(1).find("radius="), std::string::npos);
  EXPECT_EQ(parameters(1), parameters(2));
}

TEST_F(AutoShot, GoesOn) {
  make_changing_shot();
  ASSERT_EQ(automatic({"--radius", "0.5", "--keep-depth", "--float"}).status, 0);
  EXPECT_EQ(FrameFile(path("out.0001.exr"), {}).all_channels(), (std::vector<std::string>{"AO", "Y", "Z"}));
  const std::map<std::string, std::string> whole = contents("out.");
  fs::remove(path("out.0002.exr"));
  const Result result = automatic({"--radius", "0.5", "--keep-depth", "--float", "--resume", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json summary = lines_of(result.out).back();
  EXPECT_EQ(summary["skipped"], 2);
  EXPECT_EQ(summary["done"], 1);
  EXPECT_NE(summary["notes"].dump().find("wanted in 1 of 1 frames computed"), std::string::npos) << summary;
  EXPECT_EQ(contents("out."), whole);
}

TEST_F(AutoShot, AFrameThatFailsLeavesTheOthers) {
  make_changing_shot();
  std::ofstream(path(numbered("shot", 1))) << "no EXR";
  const Result result = automatic({"--radius", "0.5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("gloam: 1 of 3 frames failed: 1\n"), std::string::npos) << result.err;
  EXPECT_EQ(contents("out.").size(), 2u);
}

TEST_F(AutoShot, RefusesInOneLine) {
  make_shot({1, 2});
  const std::string shot = file("shot.####.exr"), one = file("shot.0001.exr"), out = file("out.####.exr");
  expect_refused({"auto", shot, "-o", file("out.exr")}, 2, {"is one file", "patterns"});
  expect_refused({"auto", one, "-o", out}, 2, {"is a pattern", "is one frame"});
  expect_refused({"auto", shot, "-o", shot}, 2, {"is also what frame 1 is read from"});
  expect_refused({"auto", shot, "-o", out, "--explain", file("why.png")}, 2, {"--explain", "one frame"});
  expect_refused({"auto", shot, "-o", out, "--measure"}, 2, {"--measure"});
  expect_refused({"auto", shot, "-o", out, "--mask", "measured"}, 2, {"--mask measured", "always or never"});
  expect_refused({"auto", shot, "-o", out, "--frames", "1-5"}, 1, {"frames 3-5 are missing"});
  expect_refused({"auto", one, "-o", file("out.exr"), "--resume"}, 2, {"--resume", "is one frame"});
}

}  // namespace
}  // namespace gloam::test::auto_shot_test
