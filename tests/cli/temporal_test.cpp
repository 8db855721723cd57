// gloam run --temporal: each frame of a shot goes on from the one before.
#include "cli/shot_fixture.h"

namespace gloam::test::temporal_test {
namespace {

using Json = nlohmann::json;

class Temporal : public ShotTest {
 protected:
  double rmse(const std::string& test, const std::string& truth) const {
    return gloam({"compare", path(test), path(truth), "--frame", path("shot.0009.exr"), "--json", "-"}).json()["rmse"];
  }
};

TEST_F(Temporal, AShotIsNearerToTheTruthThanItsFramesAlone) {
  walk(9, 0.02, 320, 180);
  ASSERT_EQ(run_of({"--temporal"}).size(), 8u);
  const auto last_of = [&](const Arguments& more) {
    Arguments all = run_of({"--float"}, "gtao");
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  last_of({"--temporal"});
  std::filesystem::rename(path("ao.0009.exr"), path("temporal.exr"));
  last_of({"--seed", "9"});
  ASSERT_EQ(
      gloam({"reference", "ao", path("shot.0009.exr"), "--samples", "128", "--radius", "0.5", "-o", path("truth.exr")})
          .status,
      0);
  const double temporal = rmse("temporal.exr", "truth.exr"), alone = rmse("ao.0009.exr", "truth.exr");
  std::printf("RMSE: one frame %.4f, nine frames %.4f\n", alone, temporal);
  // Most of the error is no noise: 16 slices leave .94 of that of one on the built-in walk.
  EXPECT_LT(temporal, 0.96 * alone);
}

TEST_F(Temporal, AShotIsWhatFrameAfterFrameIs) {
  walk(3, 0.02, 64, 36);
  ASSERT_EQ(gloam(run_of({"--temporal", "--float"}, "gtao")).status, 0);
  ASSERT_EQ(gloam({"run", "gtao", path("shot.0001.exr"), "-o", path("r.0001.exr"), "--radius", "0.5", "--temporal",
                   "--seed", "1"})
                .status,
            0);
  for (const int i : {2, 3}) {
    const Result next = gloam({"run", "gtao", path(numbered("shot", i)), "-o", path(numbered("r", i)), "--radius",
                               "0.5", "--history", path(numbered("r", i - 1))});
    ASSERT_EQ(next.status, 0) << next.err;
  }
  const Json compared = gloam({"compare", path("ao.0003.exr"), path("r.0003.exr"), "--json", "-"}).json();
  // Cameras in headers are floats.
  EXPECT_LT(double(compared["max"]), 1e-5) << compared;
}

TEST_F(Temporal, ReflectionsOfAShotGoOn) {
  walk(3, 0.02, 64, 36);
  Arguments all = run_of({"--temporal"}, "sssr");
  std::erase(all, "--radius");
  std::erase(all, "0.5");
  ASSERT_EQ(gloam(all).status, 0);
  const auto temporal = contents();
  all[1] = "temporal-sssr";
  std::erase(all, "--temporal");
  ASSERT_EQ(gloam(all).status, 0);
  EXPECT_EQ(FrameFile(path("ao.0003.exr"), {}).common_planes(), std::vector<std::string>{"reflection"});
  EXPECT_EQ(temporal.size(), 3u);
}

TEST_F(Temporal, KilledOrDividedItWritesTheSameBytes) {
  // Across the border of two blocks of frames.
  walk(9, 0.02, 64, 36);
  for (int i = 9; i >= 1; --i) renumber(i, i + 58);
  const Arguments command = run_of({"--temporal", "-q"}, "gtao");
  ASSERT_EQ(gloam(command).status, 0);
  const auto whole = contents();
  ASSERT_EQ(whole.size(), 9u);

  // Divided.
  Arguments divided = command;
  divided.insert(divided.end(), {"--chunks", "5", "--print"});
  const Result printed = gloam(divided);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_NE(printed.out.find("--frames 59-67 --warm-up 5 --resume"), std::string::npos) << printed.out;
  for (const auto& [name, unused] : whole) std::filesystem::remove(path(name));
  EXPECT_EQ(std::system(("bash -ec '" + printed.out + "'").c_str()), 0) << printed.out;
  EXPECT_EQ(contents(), whole);

  // Some files lost: the frames that go on from them are written again, with the same bytes.
  Arguments resumed = command;
  resumed.emplace_back("--resume");
  for (const int lost : {66, 61}) {
    std::filesystem::remove(path(numbered("ao", lost)));
    const Result result = gloam(resumed);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(contents(), whole) << lost;
  }
  EXPECT_NE(gloam(run_of({"--temporal", "--resume"}, "gtao")).out.find("left 9 frames alone"), std::string::npos);
}

TEST_F(Temporal, ResumeKnowsTheFramesThatAFrameGoesOnFrom) {
  walk(6, 0.02, 64, 36);
  const Arguments command = run_of({"--temporal", "-q", "--plane", "motion=none"}, "gtao");
  const auto with = [&](const Arguments& more) {
    Arguments all = command;
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return contents();
  };
  const auto first = with({});
  // Another third frame: what goes on from it is written again, even if only the third had been when the process was killed.
  std::filesystem::copy_file(path("shot.0005.exr"), path("shot.0003.exr"),
                             std::filesystem::copy_options::overwrite_existing);
  const auto resumed = with({"--resume"}), fresh = with({});
  EXPECT_EQ(resumed, fresh);
  EXPECT_NE(fresh.at("ao.0006.exr"), first.at("ao.0006.exr"));
  for (const int i : {4, 5, 6}) std::ofstream(path(numbered("ao", i)), std::ios::binary) << first.at(numbered("ao", i));
  EXPECT_EQ(with({"--resume"}), fresh);
  // Other frames in between.
  const auto every_second = with({"--frames", "1-5x2"});
  with({});
  EXPECT_EQ(with({"--frames", "1-5x2", "--resume"}), every_second);
}

TEST_F(Temporal, AChunkKnowsTheFramesThatLeadToIt) {
  walk(9, 0.02, 64, 36);
  for (int i = 9; i >= 1; --i) renumber(i, i + 58);
  const Arguments second = {"--temporal", "--frames", "59-67", "--warm-up", "5", "--resume", "--plane", "motion=none"};
  ASSERT_EQ(gloam(run_of(second, "gtao")).status, 0);
  EXPECT_NE(gloam(run_of(second, "gtao")).out.find("left 4 frames alone"), std::string::npos);
  std::filesystem::copy_file(path("shot.0063.exr"), path("shot.0060.exr"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(gloam(run_of(second, "gtao")).out.find("wrote 4 frames"), std::string::npos);
  // A frame that leads to the chunk cannot be read.
  std::ofstream(path("shot.0060.exr")) << "no image";
  const Result broken = gloam(run_of(second, "gtao"));
  EXPECT_EQ(broken.status, 0) << broken.err;
  EXPECT_NE(broken.err.find("frame 60: failed, and frames that go on from it begin anew"), std::string::npos)
      << broken.err;
  EXPECT_NE(broken.out.find("wrote 4 frames"), std::string::npos) << broken.out;
}

TEST_F(Temporal, OneOfTwoViewsGoesOn) {
  ASSERT_EQ(gloam({"capture", "gallery", "--shot", "walk", "-o", file("shot.####.exr"), "--frames", "1-3", "--size",
                   "40x28", "--planes", "depth,normal", "--stereo", "0.3", "--peel", "2"})
                .status,
            0);
  const Result result = gloam(run_of({"--temporal"}, "multiview"));
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(Temporal, SaysWhereAHistoryIsOfNoUse) {
  walk(4, 0.02, 64, 36);
  const auto said = [&](const Arguments& more) {
    const Result result = gloam(run_of(more, "gtao"));
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  EXPECT_NE(
      said({"--temporal", "--frames", "1,3,4"}).find("frame 3: its motion leads to frame 2, which is not computed"),
      std::string::npos);
  // A cut: frame 3 shows another place.
  ASSERT_EQ(gloam({"capture", "courtyard", "-o", path("shot.0003.exr"), "--size", "64x36", "--eye", "3,7.3,2",
                   "--target", "9,4,-3"})
                .status,
            0);
  const std::string cut = said({"--temporal", "--plane", "motion=none"});
  EXPECT_NE(cut.find("frame 3: shows next to nothing that the frame before showed"), std::string::npos) << cut;
  EXPECT_NE(cut.find("frame 4: shows next to nothing"), std::string::npos) << cut;
  EXPECT_EQ(cut.find("frame 2"), std::string::npos) << cut;
  const Result other =
      gloam({"run", "gtao", path("shot.0003.exr"), "-o", path("r.exr"), "--radius", "0.5", "--temporal"});
  ASSERT_EQ(other.status, 0) << other.err;
  const Result after =
      gloam({"run", "gtao", path("shot.0002.exr"), "-o", path("s.exr"), "--radius", "0.5", "--history", path("r.exr")});
  EXPECT_EQ(after.status, 0) << after.err;
  EXPECT_NE(after.err.find("r.exr: shows next to nothing that shot.0002.exr shows"), std::string::npos) << after.err;
}

TEST_F(Temporal, SaysWhereNothingTellsOfMotion) {
  make_shot({1, 2});
  const Result result = gloam(run_of({"--temporal", "--fov", "60"}, "gtao"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("neither a plane 'motion' nor the camera's pose"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace gloam::test::temporal_test
