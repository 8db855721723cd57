// gloam compare on sequences.
#include <cmath>
#include <opencv2/core.hpp>

#include "cli/shot_fixture.h"
#include "picture/picture.h"

namespace gloam::test::compare_sequence_test {
namespace {

class CompareSequence : public ShotTest {
 protected:
  /// Frames of AO, without depth.
  void make_ao(const std::string& stem, const std::vector<std::pair<int, float>>& frames, int width = 32) const {
    for (const auto& [number, ao] : frames) {
      Frame frame;
      frame.display = frame.window = {0, 0, width, 24};
      frame.views.push_back({""});
      Plane plane{"ao", {}};
      plane.channels.emplace_back(Layout(width, 24), ao);
      frame.views[0].planes.emplace("ao", std::move(plane));
      write_frame(path(numbered(stem, number)), frame);
    }
  }

  /// Frames of the scene `gallery` with depth, and results of two presets as test and truth.
  void make_gallery() const {
    std::ofstream(path("path.json"))
        << R"({"width": 96, "height": 54, "fx": 64, "fy": 64, "cx": 48, "cy": 27, "frames": 4,
               "path": [{"camera_to_world": [[1, 0, 0, 1.6], [0, 1, 0, 1.65], [0, 0, 1, 2.5], [0, 0, 0, 1]]},
                        {"camera_to_world": [[1, 0, 0, 1.7], [0, 1, 0, 1.65], [0, 0, 1, 2.2], [0, 0, 0, 1]]}]})";
    ok({"capture", "gallery", "-o", file("shot.exr"), "--size", "96x54", "--planes", "normal,motion", "--camera-path",
        file("path.json")});
    ok({"run", "gtao", file("shot.####.exr"), "-o", file("test.####.exr"), "--preset", "low", "--radius", "0.5"});
    ok({"run", "gtao", file("shot.####.exr"), "-o", file("truth.####.exr"), "--preset", "high", "--radius", "0.5",
        "--keep-depth"});
  }

  static void expect_says(const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }

  Result ok(const Arguments& arguments) const {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }

  nlohmann::json document(const Arguments& more) const {
    Arguments arguments = {"compare", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(ok(arguments).out);
  }
};

TEST_F(CompareSequence, EachFrameHasTheFiguresOfAComparisonOfItAlone) {
  make_gallery();
  const nlohmann::json all =
      document({file("test.####.exr"), file("truth.####.exr"), "--frame", file("shot.####.exr")});
  ASSERT_EQ(all["frames"].size(), 4u);
  double sum = 0, worst = 0;
  for (const nlohmann::json& row : all["frames"]) {
    const int frame = row["frame"];
    const nlohmann::json one = document(
        {file(numbered("test", frame)), file(numbered("truth", frame)), "--frame", file(numbered("shot", frame))});
    for (const char* figure :
         {"pixels", "mae", "rmse", "bias", "psnr", "max", "over_1_255", "over_0_05", "ssim", "gmsd"})
      EXPECT_EQ(row[figure], one[figure]) << figure << " of frame " << frame;
    sum += row["rmse"].get<double>();
    worst = std::max(worst, row["rmse"].get<double>());
  }
  const nlohmann::json& summary = all["summary"];
  EXPECT_NEAR(summary["mean"]["rmse"].get<double>(), sum / 4, 1e-12);
  EXPECT_EQ(summary["worst"]["rmse"], worst);
  EXPECT_EQ(all["frames"][summary["worst"]["frame"].get<size_t>() - 1]["rmse"], worst);
  EXPECT_EQ(summary["pairs"], 3);
}

TEST_F(CompareSequence, MotionOfThePlaneIsThatOfCamerasAndDepth) {
  make_gallery();
  const nlohmann::json plane =
      document({file("test.####.exr"), file("truth.####.exr"), "--frame", file("shot.####.exr")})["summary"];
  const nlohmann::json cameras = document({file("test.####.exr"), file("truth.####.exr")})["summary"];
  EXPECT_EQ(plane["motion"], "plane, of --frame");
  EXPECT_EQ(cameras["motion"], "cameras and depth, of the truth");
  EXPECT_GT(plane["flicker"], 0.001);
  EXPECT_NEAR(plane["flicker"].get<double>(), cameras["flicker"].get<double>(), 1e-5);
  EXPECT_NEAR(plane["comparable"].get<double>(), cameras["comparable"].get<double>(), 1e-3);
  EXPECT_GT(plane["comparable"], 0.9);
  EXPECT_LT(plane["comparable"], 1);
}

TEST_F(CompareSequence, OfTheTruthItselfHasNoFlicker) {
  make_gallery();
  const nlohmann::json same = document({file("truth.####.exr"), file("truth.####.exr")})["summary"];
  EXPECT_EQ(same["flicker"], 0);
  EXPECT_GT(same["truth_change"], 0.001);
}

TEST_F(CompareSequence, NamesTheWorstFrameLast) {
  make_ao("test", {{1, 0.5f}, {2, 0.75f}, {3, 0.625f}});
  make_ao("truth", {{1, 0.5f}, {2, 0.5f}, {3, 0.5f}});
  const Result result = ok({"compare", file("test.####.exr"), file("truth.%04d.exr"), "--sequence"});
  EXPECT_TRUE(result.out.ends_with("\nworst frame 2: RMSE 0.25000\n")) << result.out;
  expect_says(result.out, "motion: none, the image is taken to stand still\n");
  expect_says(result.err, "no depth in either file");
  // changes of the error: 0.25 and -0.125
  const nlohmann::json summary = document({file("test.####.exr"), file("truth.####.exr")})["summary"];
  EXPECT_NEAR(summary["flicker"].get<double>(), std::sqrt((0.0625 + 0.015625) / 2), 1e-9);
}

TEST_F(CompareSequence, MeasuresNoFlickerAcrossAGap) {
  make_ao("test", {{1, 0.5f}, {2, 0.75f}, {4, 0.25f}, {5, 0.25f}});
  make_ao("truth", {{1, 0.5f}, {2, 0.5f}, {3, 0.5f}, {4, 0.5f}, {5, 0.5f}});
  expect_refused({"compare", file("test.####.exr"), file("truth.####.exr")}, 1, {"test.0003.exr"});
  const Result refused = gloam({"compare", file("test.####.exr"), file("truth.####.exr")});
  EXPECT_EQ(refused.err.find("hold"), std::string::npos)
      << "what compare does not take is not advised: " << refused.err;
  const nlohmann::json all = document({file("test.####.exr"), file("truth.####.exr"), "--missing", "skip"});
  EXPECT_EQ(all["summary"]["frames"], 4);
  EXPECT_EQ(all["summary"]["pairs"], 2);
  EXPECT_EQ(all["frames"][1]["flicker"], 0.25);
  EXPECT_TRUE(all["frames"][2]["flicker"].is_null()) << "frame 3 is not there";
  EXPECT_EQ(all["frames"][3]["flicker"], 0);
  const Result apart = ok({"compare", file("test.####.exr"), file("truth.####.exr"), "--frames", "1,4"});
  expect_says(apart.err, "no two frames follow one another");
}

TEST_F(CompareSequence, TakesOneTruthForAllFrames) {
  make_ao("test", {{1, 0.5f}, {2, 0.75f}});
  make_ao("truth", {{1, 0.5f}});
  const Result result = ok({"compare", file("test.####.exr"), file("truth.0001.exr")});
  expect_says(result.out, "worst frame 2: RMSE 0.25000");
  expect_says(result.err, "is one file for all frames: the camera is taken to stand still");
}

TEST_F(CompareSequence, DrawsAPlotAndAMovieInOneScale) {
  make_ao("test", {{1, 0.53f}, {2, 0.9f}});
  make_ao("truth", {{1, 0.5f}, {2, 0.5f}});
  const Result result = ok({"compare", file("test.####.exr"), file("truth.####.exr"), "-o", file("plot.png"),
                            "--differences", file("movie.####.png")});
  expect_says(result.out, "2 frames, colours to +-0.5\n");
  EXPECT_GT(fs::file_size(path("plot.png")), 5000u);
  for (const int frame : {1, 2})
    ok({"compare", file(numbered("test", frame)), file(numbered("truth", frame)), "-o",
        file(fmt::format("alone.{}.png", frame))});
  EXPECT_EQ(slurp(path("movie.0002.png")), slurp(path("alone.2.png"))) << "this frame has the larger scale";
  EXPECT_NE(slurp(path("movie.0001.png")), slurp(path("alone.1.png"))) << "alone it has a scale to 0.05";
}

TEST_F(CompareSequence, TwoEyesHaveTheInconsistencyOfEachFrameAlone) {
  for (const int frame : {1, 2})
    ok({"capture", "gallery", "-o", file(numbered("pair", frame)), "--size", "96x54", "--planes", "normal", "--stereo",
        frame == 1 ? "0.065" : "0.2"});
  ok({"run", "gtao", file("pair.####.exr"), "-o", file("eyes.####.exr"), "--radius", "0.5", "--preset", "low",
      "--keep-depth"});
  const nlohmann::json all = document({"--stereo", file("eyes.####.exr"), "-o", file("plot.png")});
  std::vector<double> means;
  for (const int frame : {1, 2}) {
    const nlohmann::json one = document({"--stereo", file(numbered("eyes", frame))});
    const nlohmann::json& row = all["frames"][size_t(frame) - 1];
    EXPECT_EQ(row["frame"], frame);
    EXPECT_EQ(row["inconsistency"], one["inconsistency"]);
    EXPECT_EQ(row["pixels"], one["pixels"]);
    means.push_back(one["inconsistency"]["mean"]);
  }
  ASSERT_NE(means[0], means[1]);
  const nlohmann::json& summary = all["summary"];
  EXPECT_NEAR(summary["inconsistency"].get<double>(), (means[0] + means[1]) / 2, 1e-12);
  EXPECT_EQ(summary["worst"]["frame"], means[0] > means[1] ? 1 : 2);
  EXPECT_GT(fs::file_size(path("plot.png")), 5000u);
  const Result told = ok({"compare", "--stereo", file("eyes.####.exr"), "--frame", file("pair.####.exr")});
  expect_says(told.out, fmt::format("worst frame {}: ", means[0] > means[1] ? 1 : 2));
}

TEST_F(CompareSequence, RefusesInALine) {
  make_ao("test", {{1, 0.5f}, {2, 0.75f}});
  make_ao("truth", {{1, 0.5f}, {2, 0.5f}});
  make_ao("wide", {{1, 0.5f}}), make_ao("wide", {{2, 0.5f}}, 40);
  const std::string test = file("test.####.exr"), truth = file("truth.####.exr"), one = file("test.0001.exr");
  expect_refused({"compare", one, truth}, 2, {"REF.exr", "truth.####.exr", "TEST.exr", "test.0001.exr is one file"});
  expect_refused({"compare", one, file("truth.0001.exr"), "--frame", truth}, 2, {"--frame", "is one file"});
  expect_refused({"compare", one, file("truth.0001.exr"), "--sequence"}, 2, {"--sequence", "is one file"});
  expect_refused({"compare", one, file("truth.0001.exr"), "--frames", "1-2"}, 2, {"--frames", "is one file"});
  expect_refused({"compare", one, file("truth.0001.exr"), "--differences", file("d.####.png")}, 2,
                 {"--differences", "is one file"});
  expect_refused({"compare", test}, 2, {"REF.exr is required"});
  expect_refused({"compare", test, "--stereo"}, 1, {"frame 1"});
  expect_refused({"compare", test, one, "--stereo"}, 2, {"REF.exr", "is one file"});
  expect_refused({"compare", test, "--stereo", "--anaglyph", file("both.png")}, 2, {"--anaglyph", "leave it out"});
  expect_refused({"compare", test, "--stereo", "--differences", file("d.####.png")}, 2,
                 {"--differences", "leave it out"});
  expect_refused({"compare", file("none.####.exr"), truth}, 1, {"frame"});
  expect_refused({"compare", test, file("none.####.exr")}, 1, {"none.0001.exr"});
  expect_refused({"compare", test, truth, "--frames", "1-3"}, 1, {"test.0003.exr"});
  expect_refused({"compare", test, truth, "--missing", "hold"}, 2, {"--missing", "hold", "error"});
  expect_refused({"compare", test, file("wide.####.exr")}, 1, {"frame 2", "32x24", "40x24"});
  expect_refused({"compare", file("wide.####.exr"), file("wide.####.exr")}, 1, {"frame 2", "40x24", "32x24"});
  expect_refused({"compare", test, truth, "--frame", truth}, 1, {"frame 1", "no depth"});
  expect_refused({"compare", test, truth, "-o", file("plot.####.png")}, 2, {"-o", "--differences"});
  expect_refused({"compare", test, truth, "--differences", file("d.png")}, 2, {"--differences", "####"});
  expect_refused({"compare", test, truth, "--differences", file("no/d.####.png")}, 1, {"--differences", "no"});
  expect_refused({"compare", test, truth, "--json", file("truth.0002.exr")}, 2, {"--json", "truth.0002.exr"});
  std::ofstream(path("truth.0002.exr")) << "damaged";
  expect_refused({"compare", test, truth, "-o", file("plot.png"), "--differences", file("d.####.png")}, 1,
                 {"frame 2", "truth.0002.exr"});
}

/// Without a pair there is no change from frame to frame: an empty chart would look as if it were 0.
TEST_F(CompareSequence, APlotWithoutPairsHasNoPanelOfThem) {
  make_ao("test", {{1, 0.5f}, {2, 0.6f}, {4, 0.7f}});
  make_ao("truth", {{1, 0.5f}, {2, 0.5f}, {4, 0.5f}});
  const auto height_of = [&](const char* frames) {
    ok({"compare", file("test.####.exr"), file("truth.####.exr"), "--frames", frames, "-o", file("plot.png")});
    return read_png(path("plot.png")).rows;
  };
  const int both = height_of("1,2"), errors_alone = height_of("2,4");
  EXPECT_LT(errors_alone, 0.75 * both);
  EXPECT_GT(errors_alone, 0.4 * both);
}

}  // namespace
}  // namespace gloam::test::compare_sequence_test
