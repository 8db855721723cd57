// gloam capture along a path or a built-in shot: which frames are made, their names, and motion in every view.
#include "cli/shot_fixture.h"
#include "gloam/projection.h"

namespace gloam::test::capture_shot_test {
namespace {

class CaptureShots : public ShotTest {
 protected:
  void SetUp() override {
    ShotTest::SetUp();
    std::ofstream(path("path.json"))
        << R"({"width": 64, "height": 36, "fx": 60, "fy": 60, "cx": 32, "cy": 18, "frames": 4, "path": [
      {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]},
      {"camera_to_world": [[1,0,0,1.5],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]})";
  }
  Result capture_small(const std::string& scene, const std::string& out, const Arguments& more) const {
    Arguments all = {"capture", scene, "-o", file(out), "--size", "64x36", "--planes", "position"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
  void expect_same_file(const std::string& one, const std::string& other) const {
    EXPECT_GT(slurp(path(one)).size(), 0u) << one;
    EXPECT_TRUE(slurp(path(one)) == slurp(path(other))) << one << " and " << other << " differ";
  }
};

TEST_F(CaptureShots, AFrameOfAListIsThatOfTheWholeShot) {
  for (const auto& [scene, shot] : {std::pair("clockwork", "gears"), {"gallery", "walk"}}) {
    ASSERT_EQ(capture_small(scene, "all.####.exr", {"--shot", shot, "--frames", "1-4"}).err, "");
    ASSERT_EQ(capture_small(scene, "some.%04d.exr", {"--shot", shot, "--frames", "2-4x2"}).err, "");
    EXPECT_EQ(contents("all.").size(), 4u);
    EXPECT_EQ(contents("some.").size(), 2u);
    for (const char* number : {"0002", "0004"})
      expect_same_file(fmt::format("all.{}.exr", number), fmt::format("some.{}.exr", number));
  }
}

// A scene from a file has no radius of its own: all frames state the first one's.
TEST_F(CaptureShots, TheRadiusOfAPathIsThatOfItsFirstFrame) {
  std::ofstream(path("wall.obj")) << "v -9 -9 0\nv 9 -9 0\nv 9 9 -9\nv -9 9 0\nf 1 2 3\nf 1 3 4\n";
  ASSERT_EQ(capture_small(file("wall.obj"), "all.exr", {"--camera-path", file("path.json")}).status, 0);
  ASSERT_EQ(
      capture_small(file("wall.obj"), "some.####.exr", {"--camera-path", file("path.json"), "--frames", "3,4"}).status,
      0);
  EXPECT_EQ(contents("all.").size(), 4u) << "numbered, without a pattern";
  expect_same_file("all.0003.exr", "some.0003.exr");
  expect_same_file("all.0004.exr", "some.0004.exr");
}

TEST_F(CaptureShots, FramesOfAPathHaveTheSizeThatItsFileStates) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("s.exr"), "--planes", "position", "--camera-path", file("path.json"),
                   "--frames", "1"})
                .status,
            0);
  const FrameFile frame(path(numbered("s", 1)), {});
  EXPECT_EQ(frame.display().width(), 64);
  EXPECT_EQ(frame.display().height(), 36);
}

TEST_F(CaptureShots, BothEyesMove) {
  ASSERT_EQ(capture_small("plane", "pair.####.exr",
                          {"--tilt", "0", "--camera-path", file("path.json"), "--stereo", "0.1", "--frames", "3"})
                .err,
            "");
  const Frame frame = FrameFile(path("pair.0003.exr"), {}).read({"motion"});
  ASSERT_EQ(frame.views.size(), 2u);
  for (const View& view : frame.views)
    EXPECT_NEAR(view.planes.at("motion").channels[0].at(30, 20), 0.5 * 60 / 4, 1e-3) << view.name;
}

/// What a module shows is where the module of the frame before had it.
TEST_F(CaptureShots, ModulesOfADisplayMove) {
  const Arguments display = {"--shot",    "dolly",     "--frames",
                             "2,3",       "--display", GLOAM_SOURCE_DIR "/data/displays/small.json",
                             "--modules", "0,3"};
  Arguments separate = display;
  separate.push_back("--separate");
  ASSERT_EQ(capture_small("colonnade", "m.####.exr", display).err, "");
  FrameFile before(path("m.0002.exr"), {});
  const Frame frame = FrameFile(path("m.0003.exr"), {}).read({"motion", "position"});
  ASSERT_EQ(frame.views.size(), 2u);
  for (const View& view : frame.views) {
    int compared = 0;
    double farthest = 0;
    for (int y = 0; y < 36; ++y) {
      for (int x = 0; x < 64; ++x) {
        const float motion[2] = {view.planes.at("motion").channels[0].at(x, y),
                                 view.planes.at("motion").channels[1].at(x, y)};
        glm::dvec3 world = view.origin;
        for (int i = 0; i < 3; ++i) world[i] += double(view.planes.at("position").channels[size_t(i)].at(x, y));
        const auto was = pixel_of_world(*before.camera(view.name), world, 1);
        if (!was || !std::isfinite(motion[0]) || (motion[0] == 0 && motion[1] == 0)) continue;
        ++compared;
        farthest = std::max(farthest, glm::length(*was - glm::dvec2(x + 0.5, y + 0.5)));
        EXPECT_NEAR(motion[0], was->x - x - 0.5, 0.02) << view.name << " " << x << ", " << y;
        EXPECT_NEAR(motion[1], was->y - y - 0.5, 0.02) << view.name << " " << x << ", " << y;
      }
    }
    EXPECT_GT(compared, 1000) << view.name;
    EXPECT_GT(farthest, 0.1) << view.name;
  }
  ASSERT_EQ(capture_small("colonnade", "s.####.exr", separate).err, "");
  for (const char* name : {"s.0002.module00.exr", "s.0003.module03.exr"}) EXPECT_TRUE(fs::exists(path(name))) << name;
}

TEST_F(CaptureShots, NothingMovesInTheFirstFrame) {
  for (const auto& [scene, shot] : {std::pair("gallery", "walk"), std::pair("clockwork", "gears")}) {
    ASSERT_EQ(gloam({"capture", scene, "-o", file("s.####.exr"), "--size", "64x36", "--shot", shot, "--frames", "1",
                     "--planes", "motion"})
                  .status,
              0);
    const Frame frame = FrameFile(path("s.0001.exr"), {.as_stored = true}).read({"motion"});
    for (const Channel& channel : frame.views[0].planes.at("motion").channels)
      for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_EQ(channel.at(x, y), 0) << shot << " " << x << ", " << y;
  }
}

TEST_F(CaptureShots, PicturesHaveNumbersToo) {
  ASSERT_EQ(gloam({"capture", "clockwork", "-o", file("c.####.exr"), "--size", "32x18", "--shot", "gears", "--frames",
                   "48", "--picture", file("p.####.png")})
                .err,
            "");
  EXPECT_EQ(files(), (std::vector<std::string>{"c.0048.exr", "p.0048.png", "path.json"}));
  EXPECT_NE(FrameFile(path("c.0048.exr"), {}).text_attribute("gloamScene").find("time=1.95"), std::string::npos)
      << "the truth of the frame finds its scene by it";
}

TEST_F(CaptureShots, AreListed) {
  const nlohmann::json shots = gloam({"list", "shots", "--json", "-"}).json();
  ASSERT_EQ(shots.size(), 4u);
  int moving = 0;
  for (const nlohmann::json& shot : shots) {
    EXPECT_EQ(shot["frames"], 48);
    moving += shot["moves_objects"].get<bool>();
    EXPECT_EQ(gloam({"capture", shot["scene"], "-o", file("x.exr"), "--size", "8x8", "--planes", "depth", "--shot",
                     shot["shot"], "--frames", "2"})
                  .status,
              0);
  }
  EXPECT_EQ(moving, 1);
}

TEST_F(CaptureShots, RefusesInOneLine) {
  const auto refused = [&](const std::string& scene, const std::string& out, const Arguments& more,
                           const std::vector<std::string>& says) {
    Arguments all = {"capture", scene, "-o", file(out), "--size", "64x36"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 2, says);
  };
  refused("gallery", "s.exr", {"--shot", "wlak"}, {"--shot wlak", "did you mean 'walk'"});
  refused("fence", "s.exr", {"--shot", "walk"}, {"fence has no shots", "gloam list shots"});
  refused("wall.obj", "s.exr", {"--shot", "walk"}, {"not a built-in scene", "--camera-path"});
  refused("gallery", "s.exr", {"--shot", "walk", "--frames", "47-50"}, {"--frames 50", "frames 1 to 48"});
  refused("gallery", "s.exr", {"--shot", "walk", "--frames", "0-3"}, {"--frames 0", "frames 1 to 48"});
  refused("plane", "s.exr", {"--camera-path", file("path.json"), "--frames", "5"}, {"--frames 5", "frames 1 to 4"});
  refused("gallery", "s.exr", {"--frames", "1"}, {"--frames", "--shot NAME"});
  refused("gallery", "s.####.exr", {}, {"s.####.exr", "--camera-path FILE.json"});
  refused("gallery", "s.exr", {"--shot", "walk", "--camera-path", file("path.json")}, {"--camera-path and --shot"});
  refused("gallery", "s.exr", {"--shot", "walk", "--fov", "50"}, {"--shot", "--fov"});
  refused("gallery", "s.exr", {"--shot", "walk", "--view2", "10"}, {"--view2 and --shot", "--stereo"});
  refused("clockwork", "s.exr", {"--time", "3601"}, {"time", "0 to 3600"});
  refused("clockwork", "s.exr", {"--shot", "gears", "--set", "time=1"}, {"time", "leave it out"});
}

}  // namespace
}  // namespace gloam::test::capture_shot_test
