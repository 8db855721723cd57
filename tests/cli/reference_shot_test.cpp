// gloam reference on a shot: the truth of each frame is that of the frame alone, whatever happens in between.
#include <csignal>

#include "base/lists.h"
#include "cli/shot_fixture.h"

namespace gloam::test::reference_shot_test {
namespace {

class TruthsOfAShot : public ShotTest {
 protected:
  void SetUp() override {
    ShotTest::SetUp();
    ASSERT_EQ(gloam({"capture", "clockwork", "-o", file("c.####.exr"), "--size", "48x27", "--planes", "normal",
                     "--shot", "gears", "--frames", "1-4"})
                  .status,
              0);
  }
  Arguments truths_of(const Arguments& more = {}, const std::string& out = "t.####.exr") const {
    Arguments all = {"reference", "ao", file("c.####.exr"), "-o", file(out)};
    if (!contains(more, std::string("--samples"))) all.insert(all.end(), {"--samples", "64"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Result trace(const Arguments& more = {}, const std::string& out = "t.####.exr") const {
    return gloam(truths_of(more, out));
  }
  /// Of the plane `ao`.
  std::vector<float> values_of(const std::string& name) const {
    const Frame frame = FrameFile(path(name), {}).read({"ao"});
    const Channel& ao = frame.views[0].planes.at("ao").channels[0];
    std::vector<float> values;
    for (int y = 0; y < frame.height(); ++y)
      for (int x = 0; x < frame.width(); ++x) values.push_back(ao.at(x, y));
    return values;
  }
};

TEST_F(TruthsOfAShot, AreThoseOfItsFramesAlone) {
  const Result traced = trace({"--seed", "7"});
  ASSERT_EQ(traced.err, "");
  EXPECT_NE(traced.out.find("(ao, ao_noise; radius 0.25 scene units)"), std::string::npos) << traced.out;
  EXPECT_EQ(contents("t.").size(), 4u);
  for (const int frame : {1, 4}) {
    ASSERT_EQ(gloam({"reference", "ao", file(numbered("c", frame)), "-o", file("alone.exr"), "--samples", "64",
                     "--seed", std::to_string(7 + frame)})
                  .status,
              0);
    EXPECT_EQ(values_of("alone.exr"), values_of(numbered("t", frame)));
    EXPECT_EQ(FrameFile(path(numbered("t", frame)), {}).number_attribute("aoRadius"), 0.25);
  }
}

// The same frame twice: its noise is another one.
TEST_F(TruthsOfAShot, NoiseDoesNotStandStill) {
  fs::remove(path("c.0002.exr"));
  ASSERT_EQ(trace({"--frames", "1,2", "--missing", "hold"}).status, 0);
  const std::vector<float> first = values_of("t.0001.exr"), held = values_of("t.0002.exr");
  const double noise = *FrameFile(path("t.0001.exr"), {}).number_attribute("aoNoise");
  double sum = 0;
  for (size_t i = 0; i < first.size(); ++i) sum += std::pow(double(first[i]) - double(held[i]), 2);
  EXPECT_NEAR(std::sqrt(sum / double(first.size())), std::sqrt(2) * noise, 0.25 * noise) << "of two independent truths";
}

TEST_F(TruthsOfAShot, ResumeMakesTheSameFiles) {
  ASSERT_EQ(trace().status, 0);
  const auto whole = contents("t.");
  const auto written = fs::last_write_time(path("t.0001.exr"));
  fs::remove(path("t.0003.exr"));
  fs::resize_file(path("t.0004.exr"), 2000);
  const Result again = trace({"--resume", "--json", "-"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(contents("t."), whole);
  EXPECT_EQ(fs::last_write_time(path("t.0001.exr")), written) << "left alone";
  const std::vector<nlohmann::json> lines = lines_of(again.out);
  EXPECT_EQ(lines[0]["status"], "skipped");
  EXPECT_EQ(lines[2]["status"], "done");
  EXPECT_EQ(lines.back()["skipped"], 2);
  EXPECT_EQ(lines.back()["done"], 2);
  for (const Arguments& other :
       {Arguments{"--samples", "96"}, {"--seed", "1"}, {"--radius", "0.3"}, {"--half"}, {"--normal-space", "world"}}) {
    Arguments flags = {"--resume", "--frames", "1", "--json", "-"};
    flags.insert(flags.end(), other.begin(), other.end());
    EXPECT_EQ(lines_of(trace(flags).out)[0]["status"], "done") << other.front() << " makes other files";
  }
}

TEST_F(TruthsOfAShot, AKilledRunGoesOn) {
  ASSERT_EQ(trace({"--samples", "1024"}, "a.####.exr").status, 0);
  const pid_t child = start(truths_of({"--samples", "1024"}, "b.####.exr"));
  for (int i = 0; i < 3000 && !fs::exists(path("b.0001.exr")); ++i) usleep(10000);
  kill(child, SIGKILL);
  finish(child);
  const Result resumed = trace({"--samples", "1024", "--resume"}, "b.####.exr");
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  for (int frame = 1; frame <= 4; ++frame)
    EXPECT_TRUE(slurp(path(numbered("a", frame))) == slurp(path(numbered("b", frame)))) << frame;
  for (const std::string& name : files()) EXPECT_EQ(name.find("partial"), std::string::npos) << name;
}

TEST_F(TruthsOfAShot, AFrameThatFailsIsToldAndTheOthersGoOn) {
  fs::resize_file(path("c.0002.exr"), 1500);
  const Result result = trace();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("frame 2: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("1 of 4 frames failed: 2"), std::string::npos) << result.err;
  EXPECT_EQ(result.lines_of_error(), 2) << result.err;
  EXPECT_EQ(contents("t.").size(), 3u);
}

TEST_F(TruthsOfAShot, MissingFrames) {
  fs::remove(path("c.0002.exr"));
  expect_refused(truths_of({"--frames", "1-4"}), 1, {"frame 2 is missing", "--missing skip"});
  ASSERT_EQ(trace({"--frames", "1-4", "--missing", "skip"}).status, 0);
  EXPECT_EQ(contents("t.").size(), 3u);
}

// Neither the frames nor the scene states a radius.
TEST_F(TruthsOfAShot, ARadiusOfEachFrameIsNoted) {
  std::ofstream(path("wall.obj")) << "v -9 -9 0\nv 9 -9 0\nv 9 9 -9\nv -9 9 0\nf 1 2 3\nf 1 3 4\n";
  const Arguments capture = {"capture", file("wall.obj"), "-o",    file("w.exr"), "--size",
                             "16x9",    "--eye",          "0,0,6", "--target",    "0,0,0"};
  ASSERT_EQ(gloam(capture).status, 0);
  for (const int number : {1, 2}) {
    Frame frame = FrameFile(path("w.exr"), {}).read({"depth", "normal"});
    frame.numbers.erase("aoRadius");
    write_frame(path(numbered("w", number)), frame);
  }
  const Result traced = gloam({"reference", "ao", file("w.####.exr"), "-o", file("t.####.exr"), "--samples", "32",
                               "--scene", file("wall.obj")});
  ASSERT_EQ(traced.status, 0) << traced.err;
  EXPECT_NE(traced.err.find("--radius gives one to all"), std::string::npos) << traced.err;
}

TEST_F(TruthsOfAShot, ReflectionsAndPictures) {
  ASSERT_EQ(gloam({"reference", "reflection", file("c.####.exr"), "-o", file("r.####.exr"), "--samples", "32",
                   "--frames", "2", "--picture", file("r.####.png")})
                .err,
            "");
  EXPECT_EQ(contents("r.").size(), 2u);
  EXPECT_TRUE(fs::exists(path("r.0002.png")));
}

// A frame's truth is that of the frame alone for every kind, and another light makes other files.
TEST_F(TruthsOfAShot, LightOfEveryKind) {
  const auto write_sky = [&](const char* camera) {
    ASSERT_EQ(
        gloam({"capture", "statue", "-o", file("sky.exr"), "--size", "64x32", "--planes", "color", "--camera", camera})
            .err,
        "");
  };
  write_sky("main");
  const std::pair<std::string, Arguments> kinds[] = {
      {"bounces", {"--bounces", "2"}},
      {"specular_occlusion", {}},
      {"indirect", {}},
      {"contact", {"--light-angle", "5"}},
      {"environment", {"--environment", file("sky.exr")}},
  };
  for (const auto& [kind, own] : kinds) {
    Arguments shot = {"reference", kind, file("c.####.exr"), "-o", file(kind + ".####.exr"),
                      "--samples", "32", "--resume"};
    Arguments alone = {"reference", kind, file("c.0003.exr"), "-o", file("alone.exr"),
                       "--samples", "32", "--seed",           "3"};
    shot.insert(shot.end(), own.begin(), own.end());
    alone.insert(alone.end(), own.begin(), own.end());
    ASSERT_EQ(gloam(shot).err, "") << kind;
    ASSERT_EQ(gloam(alone).status, 0) << kind;
    EXPECT_EQ(gloam({"compare", file(kind + ".0003.exr"), file("alone.exr"), "--json", "-"}).json()["max"], 0) << kind;
    shot.insert(shot.end(), {"--json", "-"});
    EXPECT_EQ(lines_of(gloam(shot).out).back()["skipped"], 4) << kind;
    if (kind != "environment") continue;
    write_sky("close");
    EXPECT_EQ(lines_of(gloam(shot).out).back()["done"], 4) << "under another sky of the same name";
  }
}

TEST_F(TruthsOfAShot, RefusesInOneLine) {
  const std::string shot = file("c.####.exr"), one = file("c.0001.exr");
  const auto refused = [&](const Arguments& more, const std::vector<std::string>& says) {
    Arguments all = {"reference", "ao"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, 2, says);
  };
  refused({shot, "-o", file("t.exr")}, {"t.exr", "truth.####.exr"});
  refused({one, "-o", file("t.####.exr")}, {"t.####.exr", "one frame"});
  refused({one, "-o", file("t.exr"), "--frames", "1"}, {"--frames", "one frame"});
  refused({one, "-o", file("t.exr"), "--missing", "skip"}, {"--missing", "one frame"});
  refused({one, "-o", file("t.exr"), "--resume"}, {"--resume", "one frame"});
  refused({shot, "-o", file("t.####.exr"), "--picture", file("t.png")}, {"t.png", "truth.####.png"});
  refused({shot, "-o", shot}, {"c.0001.exr", "frame 1 is read from"});
  refused({shot, "-o", file("t.####.exr"), "--missing", "guess"}, {"--missing guess", "error, skip and hold"});
  make_shot({1, 2}, "other");
  refused({file("other.####.exr"), "-o", file("t.####.exr")}, {"other.0001.exr", "--scene SCENE"});
}

}  // namespace
}  // namespace gloam::test::reference_shot_test
