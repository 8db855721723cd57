// gloam auto: the effects that a frame calls for, its output in both cases, and refusals.
#include <opencv2/core.hpp>

#include "cli/gloam_process.h"
#include "picture/picture.h"
#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::auto_test {
namespace {

using Json = nlohmann::json;

class CliAuto : public Cli {
 protected:
  Result automatic(const Scene& scene, const Arguments& more = {}, const Shot& shot = perspective(200, 120)) const {
    write_frame(path("frame.exr"), shoot(shot, scene));
    Arguments arguments = {"auto", path("frame.exr"), "-o", path("out.exr"), "--float", "--keep-depth", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    // Which way is faster may differ from run to run.
    if (std::find(more.begin(), more.end(), "--mask") == more.end())
      arguments.insert(arguments.end(), {"--mask", "always"});
    return gloam(arguments);
  }
  Frame read(const char* name) const {
    FrameFile file(path(name), {});
    return file.read({"ao"});
  }
  /// The first effect.
  Json effect_of(const Result& result) const { return result.json()["effects"][0]; }
  Json effect_of(const Result& result, const std::string& name) const {
    const Json effects = result.json()["effects"];
    for (const Json& effect : effects)
      if (effect["name"] == name) return effect;
    return nullptr;
  }
  /// Expects the planes that gloam run makes with these arguments.
  void expect_same_as_run(const Arguments& more) const {
    Arguments arguments = {"run", "evidence", path("frame.exr"), "-o", path("run.exr"), "--float"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(gloam(arguments).status, 0);
    const Frame out = read("out.exr"), expected = read("run.exr");
    EXPECT_EQ(difference(*out.views[0].find("ao"), *expected.views[0].find("ao")).max, 0);
  }
};

TEST_F(CliAuto, WhatCallsForNothingIsOpenAndNothingIsComputed) {
  const Scene nothing = [](const EyeRay&) { return std::nullopt; };
  for (const Scene& scene : {tilted_plane(3, 0.6, 1), nothing, ball({0, 0, -3}, 0.8)}) {
    const Result result = automatic(scene, {"--math", "precise"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json effect = effect_of(result);
    EXPECT_EQ(effect["name"], "ambient occlusion");
    EXPECT_EQ(effect["wanted"], false);
    EXPECT_EQ(effect["share_of_tiles"], 0);
    EXPECT_EQ(effect["why"], "nothing rises over any surface within the radius");
    EXPECT_EQ(result.json()["total_ms"], result.json()["classify_ms"]);
    expect_same_as_run({"--math", "precise"});
  }
}

TEST_F(CliAuto, WhatCallsForItHereAndThereIsMasked) {
  const Result result = automatic(room(), {"--radius", "0.2", "--measure"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json effect = effect_of(result);
  EXPECT_EQ(effect["wanted"], true);
  EXPECT_EQ(effect["everywhere"], false);
  EXPECT_GT(effect["share_of_tiles"], 0.05);
  EXPECT_LT(effect["share_of_tiles"], 0.8);
  EXPECT_GT(effect["ms_everywhere"], 0);
  expect_same_as_run({"--radius", "0.2", "--only", "corner-mask"});
}

TEST_F(CliAuto, TheCheaperWayIsTakenOfTheTwoThatAreTimed) {
  const Result result = automatic(room(), {"--radius", "0.2", "--mask", "measured"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json effect = effect_of(result);
  const double masked = effect.at("ms_masked"), everywhere = effect.at("ms_everywhere");
  EXPECT_GT(masked, 0);
  EXPECT_GT(everywhere, 0);
  const bool is_masked = masked <= 0.95 * everywhere;
  EXPECT_EQ(effect.at("masked"), is_masked) << effect;
  EXPECT_EQ(effect.at("everywhere"), !is_masked) << effect;
  EXPECT_LE(double(effect.at("ms")), std::min(masked, everywhere) / 0.95 + double(result.json().at("classify_ms")));
  EXPECT_NE(std::string(effect.at("why")).find(is_masked ? "the mask saves" : "with a mask"), std::string::npos)
      << effect;
  expect_same_as_run(is_masked ? Arguments{"--radius", "0.2", "--only", "corner-mask"} : Arguments{"--radius", "0.2"});
}

TEST_F(CliAuto, AMaskThatIsNotWantedIsNotMade) {
  const Result result = automatic(room(), {"--radius", "0.2", "--mask", "never"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result).at("masked"), false);
  EXPECT_EQ(effect_of(result).at("everywhere"), true);
  expect_same_as_run({"--radius", "0.2"});
  const Result wrong = automatic(room(), {"--mask", "mesured"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean 'measured'?"), std::string::npos) << wrong.err;
}

TEST_F(CliAuto, TheHeaderSaysWhatMadeThePlanesAsRunDoes) {
  ASSERT_EQ(automatic(room(), {"--radius", "0.2", "--seed", "3"}).status, 0);
  ASSERT_EQ(gloam({"run", "evidence", path("frame.exr"), "-o", path("run.exr"), "--radius", "0.2", "--seed", "3",
                   "--only", "corner-mask"})
                .status,
            0);
  FrameFile out(path("out.exr"), {}), expected(path("run.exr"), {});
  for (const char* name : {"gloamTechnique", "gloamParameters", "gloamRun"}) {
    EXPECT_NE(out.text_attribute(name), "") << name;
    EXPECT_EQ(out.text_attribute(name), expected.text_attribute(name)) << name;
  }
  // Different radii, to be noted.
  Frame truth = FrameFile(path("run.exr"), {}).read({"ao", "depth"});
  truth.numbers["aoRadius"] = 0.4;
  write_frame(path("truth.exr"), truth);
  EXPECT_NE(gloam({"compare", path("out.exr"), path("truth.exr")})
                .err.find("the radius of the test is 0.2, and that of the truth 0.4"),
            std::string::npos);
}

TEST_F(CliAuto, WhatCallsForItAlmostEverywhereIsNotMasked) {
  const Result result = automatic(corner(), {"--radius", "9", "--max-reach", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["everywhere"], true);
  EXPECT_EQ(effect_of(result)["ms_everywhere"], nullptr);
  expect_same_as_run({"--radius", "9", "--max-reach", "1"});
}

TEST_F(CliAuto, ASmallThingIsNotOverlooked) {
  // A ball of a few pixels on a wall.
  const Shot shot = perspective(400, 240);
  const Result result =
      automatic(nearest_of({tilted_plane(3, 0, 0), ball({0.3, 0.2, -2.97}, 0.03)}), {"--radius", "0.05"}, shot);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["wanted"], true);
}

TEST_F(CliAuto, SamplesAreTakenByTilesWhereThatIsAskedFor) {
  ASSERT_EQ(automatic(room(), {"--radius", "0.2", "--preset", "high", "--adaptive", "low"}).status, 0);
  expect_same_as_run({"--radius", "0.2", "--preset", "high", "--only", "corner-mask", "--adaptive", "low"});
}

/// The entry of a refinement.
Json refinement(const Json& effect, const std::string& technique) {
  for (const Json& choice : effect["refinements"]) {
    if (choice["technique"] == technique) return choice;
  }
  return {};
}

TEST_F(CliAuto, WhatAFrameDoesNotHoldIsNotRefined) {
  const Json effect = effect_of(automatic(room(), {"--radius", "0.2"}));
  EXPECT_EQ(effect["runs"], "evidence");
  EXPECT_EQ(refinement(effect, "sd-evidence")["wanted"], false);
  EXPECT_EQ(refinement(effect, "sd-evidence")["why"], "the frame has no 'stochastic'");
  EXPECT_EQ(refinement(effect, "stereo-evidence")["why"], "the frame has one view");
}

TEST_F(CliAuto, HiddenLayersAreLookedAtWhereTheyMatter) {
  ONLY_IN_LONG_RUN();
  ASSERT_EQ(gloam({"capture", "corridor", "-o", path("frame.exr"), "--size", "960x540", "--stochastic", "4"}).status,
            0);
  const Result result = gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--float", "--json", "-", "--measure",
                               "--mask", "always", "--set", "evidence.bias=0.02", "--explain", path("why.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json effect = effect_of(result);
  EXPECT_EQ(effect["runs"], "sd-evidence");
  EXPECT_EQ(refinement(effect, "sd-evidence")["wanted"], true);
  EXPECT_GT(refinement(effect, "sd-evidence")["share_of_tiles"], 0.2);
  EXPECT_GT(effect["ms_everywhere"], 0);
  const Arguments run = {"run", "sd-evidence", path("frame.exr"), "-o", path("run.exr"), "--float"};
  Arguments same = run, everywhere = run;
  same.insert(same.end(), {"--only", "hidden-mask", "--elsewhere", "evidence", "--set", "bias=0.02"});
  everywhere.insert(everywhere.end(), {"--set", "bias=0.02"});
  ASSERT_EQ(gloam(same).status, 0);
  EXPECT_EQ(difference(*read("out.exr").views[0].find("ao"), *read("run.exr").views[0].find("ao")).max, 0);
  // The pixels left out have hardly any occlusion by hidden layers.
  ASSERT_EQ(gloam(everywhere).status, 0);
  const double missed = difference(*read("out.exr").views[0].find("ao"), *read("run.exr").views[0].find("ao")).mean;
  ASSERT_EQ(
      gloam({"run", "evidence", path("frame.exr"), "-o", path("run.exr"), "--float", "--set", "bias=0.02"}).status, 0);
  const double all = difference(*read("out.exr").views[0].find("ao"), *read("run.exr").views[0].find("ao")).mean;
  EXPECT_LT(missed, 0.05 * all);
}

TEST_F(CliAuto, WhatOnlyHiddenLayersTellIsNotOverlooked) {
  // Nothing visible rises over anything: the pillar hides it (Figure 8 of Vermeer, Scandolo, Eisemann 2021).
  ASSERT_EQ(gloam({"capture", "pillar", "-o", path("frame.exr"), "--size", "320x180", "--stochastic", "4"}).status, 0);
  const Result result = gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-", "--mask", "always"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json effect = effect_of(result);
  EXPECT_EQ(effect["share_of_tiles"], 0);
  EXPECT_EQ(effect["wanted"], true);
  EXPECT_EQ(effect["runs"], "sd-evidence");
  ASSERT_EQ(gloam({"run", "sd-evidence", path("frame.exr"), "-o", path("run.exr"), "--only", "hidden-mask",
                   "--elsewhere", "evidence"})
                .status,
            0);
  EXPECT_EQ(difference(*read("out.exr").views[0].find("ao"), *read("run.exr").views[0].find("ao")).max, 0);
}

TEST_F(CliAuto, LayersThatHideNothingAreNotLookedAt) {
  Frame frame = shoot(perspective(200, 120), room());
  Channel& hidden = plane_of(frame, "stochastic.00").channels[0];
  for (int y = 0; y < frame.height(); ++y)
    std::copy_n(frame.views[0].find("depth")->channels[0].row(y), frame.width(), hidden.row(y));
  write_frame(path("frame.exr"), frame);
  const Result result = gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--float", "--json", "-", "--radius",
                               "0.2", "--mask", "always", "--set", "sd-evidence.samples=1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["runs"], "evidence");
  EXPECT_EQ(refinement(effect_of(result), "sd-evidence")["why"], "no hidden surface rises over a visible one");
  expect_same_as_run({"--radius", "0.2", "--only", "corner-mask"});
}

TEST_F(CliAuto, ASecondEyeTakesOverWhatTheFirstFinds) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("frame.exr"), "--size", "320x180", "--stereo", "0.065"}).status, 0);
  const Result result = gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["runs"], "stereo-evidence");
  EXPECT_GT(refinement(effect_of(result), "stereo-evidence")["share_of_tiles"], 0.8);
  ASSERT_EQ(gloam({"run", "stereo-evidence", path("frame.exr"), "-o", path("run.exr"), "--set", "estimate=mono",
                   "--set", "filter=mono"})
                .status,
            0);
  const Frame out = read("out.exr"), expected = read("run.exr");
  for (const char* eye : {"left", "right"})
    EXPECT_EQ(difference(*out.view(eye).find("ao"), *expected.view(eye).find("ao")).max, 0) << eye;
}

TEST_F(CliAuto, TwoViewsDoNotCallForReflectionsThatNothingShows) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("frame.exr"), "--size", "160x90", "--stereo", "0.065"}).status, 0);
  const Arguments command = {"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-"};
  const Result shiny = gloam(command);
  ASSERT_EQ(shiny.status, 0) << shiny.err;
  EXPECT_EQ(effect_of(shiny, "reflections")["runs"], "stereo-ssr");
  Arguments rough = command;
  rough.insert(rough.end(), {"--set", "max_roughness=0"});
  const Result nothing = gloam(rough);
  ASSERT_EQ(nothing.status, 0) << nothing.err;
  EXPECT_EQ(effect_of(nothing, "reflections")["wanted"], false);
  EXPECT_TRUE(effect_of(nothing, "reflections")["runs"].is_null());
}

TEST_F(CliAuto, TwoViewsThatShareNothingAreEstimatedByThemselves) {
  Frame frame = shoot(perspective(160, 90), room());
  View& first = frame.views.front();
  first.name = "first";
  first.camera->pose = Pose{};
  View second{.name = "second", .camera = first.camera, .origin = first.origin, .planes = {}};
  second.camera->pose->position.x += 100;
  for (const auto& [name, plane] : first.planes) second.planes.emplace(name, plane.clone());
  frame.views.push_back(std::move(second));
  write_frame(path("frame.exr"), frame);
  const Result result = gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["runs"], "evidence");
  EXPECT_EQ(refinement(effect_of(result), "stereo-evidence")["why"], "the two views have too little in common");
}

TEST_F(CliAuto, WhatIsAskedForMayKeepARefinementAway) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("frame.exr"), "--size", "160x90", "--stereo", "0.065"}).status, 0);
  const Result result =
      gloam({"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-", "--filter", "gaussian"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["runs"], "evidence");
  EXPECT_NE(refinement(effect_of(result), "stereo-evidence")["why"].get<std::string>().find("--filter gaussian"),
            std::string::npos);
}

TEST_F(CliAuto, APictureExplainsTheFrame) {
  const Result result = automatic(room(), {"--explain", path("why.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  const Result flat = automatic(tilted_plane(3, 0.6, 1), {"--explain", path("flat.png")});
  ASSERT_EQ(flat.status, 0) << flat.err;
  EXPECT_NE(slurp(path("flat.png")), slurp(path("why.png")));
  const Result told = gloam({"auto", path("frame.exr"), "-o", path("out.exr")});
  EXPECT_NE(told.out.find("nothing rises over any surface within the radius"), std::string::npos) << told.out;
}

/// Pixels of a picture that are darker than paper in its outermost columns and rows.
int inked_in_margin(const cv::Mat& picture, int margin) {
  int inked = 0;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (x < margin || y < margin || x >= picture.cols - margin || y >= picture.rows - margin)
        inked += picture.at<cv::Vec2b>(y, x)[0] < 255;
  return inked;
}

TEST_F(CliAuto, APictureHasAPanelForEachEffectThatIsPossible) {
  // Without colour there are no reflections: one effect. A panel is 400 x 240 here.
  ASSERT_EQ(automatic(room(), {"--radius", "0.2", "--explain", path("one.png")}).status, 0);
  const cv::Mat one = read_png(path("one.png"));
  EXPECT_EQ(one.cols, 1000);
  EXPECT_EQ(inked_in_margin(one, 16), 0);
  // Ambient occlusion, reflections, and what both gain from two views.
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("eyes.exr"), "--size", "200x120", "--stereo", "0.065"}).status, 0);
  ASSERT_EQ(gloam({"auto", path("eyes.exr"), "-o", path("out.exr"), "--explain", path("eyes.png")}).status, 0);
  for (const char* name : {"eyes.left.png", "eyes.right.png"}) {
    const cv::Mat picture = read_png(path(name));
    EXPECT_EQ(picture.cols, 2 * 20 + 3 * 400 + 2 * 20) << name;
    EXPECT_GT(picture.rows, 2 * 240 + one.rows - 240) << name;  // two rows of panels, and more rows in the table
    EXPECT_EQ(inked_in_margin(picture, 16), 0) << name;
  }
  EXPECT_NE(slurp(path("eyes.left.png")), slurp(path("eyes.right.png")));
}

TEST_F(CliAuto, PicturesOfTallAndOfWideFramesFitAScreen) {
  for (const auto& [w, h] : std::vector<std::pair<int, int>>{{64, 256}, {2200, 60}}) {
    ASSERT_EQ(automatic(room(), {"--radius", "0.2", "--explain", path("why.png")}, perspective(w, h)).status, 0);
    const cv::Mat picture = read_png(path("why.png"));
    EXPECT_GE(picture.cols, 1000);
    EXPECT_LE(picture.cols, 2000);
    EXPECT_LE(picture.rows, 1080) << w << "x" << h;
    EXPECT_EQ(inked_in_margin(picture, 16), 0) << w << "x" << h;
  }
}

TEST_F(CliAuto, WhatIsWrongIsSaidInOneLine) {
  const auto message = [&](const Arguments& more) {
    const Result result = automatic(room(), more);
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    return result.err;
  };
  EXPECT_NE(message({"--only", "corner-mask"}).find("--only"), std::string::npos);
  EXPECT_NE(message({"--explain", path("why.jpg")}).find("is a PNG"), std::string::npos);
  EXPECT_NE(message({"--explain", path("out.exr")}).find("PNG"), std::string::npos);
  EXPECT_NE(message({"--set", "radios=1"}).find("did you mean 'radius'"), std::string::npos);
  EXPECT_NE(
      message({"--set", "sd-evidence.sample=1"}).find("sd-evidence: no parameter 'sample' (did you mean 'samples'?)"),
      std::string::npos);
  EXPECT_NE(message({"--set", "stereo-evidence.filter=box"}).find("filter = 'box' is not allowed"), std::string::npos);
  EXPECT_NE(message({"--preset", "best"}).find("no preset 'best'"), std::string::npos);
  const Result missing = gloam({"auto", path("nothing.exr"), "-o", path("out.exr")});
  EXPECT_EQ(missing.lines_of_error(), 1) << missing.err;
}

}  // namespace
}  // namespace gloam::test::auto_test
