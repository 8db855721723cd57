// gloam auto --budget and --error: what is chosen, what is told, and refusals.
#include "cli/gloam_process.h"
#include "support/techniques.h"

namespace gloam::test::auto_budget_test {
namespace {

using Json = nlohmann::json;

class AutoBudget : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path("frame.exr"), "--size", "192x108"}).status, 0);
  }
  Result automatic(const Arguments& more, const char* frame = "frame.exr") const {
    Arguments arguments = {"auto", path(frame), "-o", path("out.exr"), "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  static Json effect_of(const Json& document, const std::string& name) {
    for (const Json& effect : document.at("effects"))
      if (effect["name"] == name) return effect;
    return nullptr;
  }
};

TEST_F(AutoBudget, MuchTimeBuysTheLeastError) {
  const Result result = automatic({"--budget", "1000s"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(document["budget_ms"], 1e6);
  EXPECT_EQ(document["goal_met"], true);
  ASSERT_GE(document["chosen"].size(), 2u) << document["chosen"];
  for (const Json& chosen : document["chosen"]) {
    EXPECT_GT(chosen["expected_ms"], 0);
    EXPECT_GE(chosen["expected_error"], 0);
    EXPECT_LT(chosen["expected_error"], effect_of(document, chosen["effect"])["change"]) << chosen;
  }
  EXPECT_GT(document["expected_error"], 0);
  EXPECT_GT(document["expected_error_uncertainty"], 0);
  EXPECT_LT(document["expected_error"], document["expected_error_of_color"]);
  const std::string why = document["why"];
  EXPECT_EQ(why.rfind("the most accurate within 1e+06 ms: evidence", 0), 0u) << why;
  EXPECT_NE(why.find("; the next faster, "), std::string::npos) << why;
}

TEST_F(AutoBudget, ATimeMayBeGivenAsFramesPerSecond) {
  const Result result = automatic({"--budget", "0.001fps"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_DOUBLE_EQ(result.json()["budget_ms"], 1e6);
  EXPECT_GE(result.json()["chosen"].size(), 2u);
  const Result missed = automatic({"--budget", "1000000fps"});
  EXPECT_NE(missed.err.find("--budget 1000000fps (0.001 ms): nothing fits"), std::string::npos) << missed.err;
}

// The planes are those of the settings that it tells.
TEST_F(AutoBudget, WhatItTellsIsWhatItDoes) {
  const Result result = automatic({"--budget", "1000s"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json all = result.json()["chosen"];
  for (const Json& chosen : all) {
    const std::string resolution = chosen["resolution"] == 1 ? "full" : chosen["resolution"] == 2 ? "half" : "quarter";
    ASSERT_EQ(gloam({"run", chosen["technique"].get<std::string>(), path("frame.exr"), "-o", path("run.exr"),
                     "--preset", chosen["preset"].get<std::string>(), "--resolution", resolution})
                  .status,
              0);
    const std::string plane = chosen["planes"][0];
    const Frame out = FrameFile(path("out.exr"), {}).read({plane}), run = FrameFile(path("run.exr"), {}).read({plane});
    EXPECT_EQ(difference(*out.views[0].find(plane), *run.views[0].find(plane)).max, 0) << chosen;
  }
}

// The look takes every second pixel of a frame of 192 x 108, and every fourth of a larger one.
TEST_F(AutoBudget, WhatTheLookHasComputedIsFilledInAndIsTheSame) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("large.exr"), "--size", "384x216"}).status, 0);
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("margin.exr"), "--size", "192x108", "--overscan", "10%"}).status,
            0);
  for (const auto& [frame, resolution] :
       {std::pair("frame.exr", "half"), std::pair("large.exr", "quarter"), std::pair("margin.exr", "half")}) {
    const Result result = automatic({"--budget", "1000s", "--preset", "low", "--resolution", resolution}, frame);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.json()["why"].get<std::string>().find(std::string(resolution) + ", from the look"),
              std::string::npos)
        << result.json()["why"];
    ASSERT_GE(result.json()["chosen"].size(), 1u);
    for (const Json& chosen : result.json()["chosen"]) {
      ASSERT_EQ(gloam({"run", chosen["technique"].get<std::string>(), path(frame), "-o", path("run.exr"), "--preset",
                       "low", "--resolution", resolution})
                    .status,
                0);
      const std::string plane = chosen["planes"][0];
      const Frame out = FrameFile(path("out.exr"), {}).read({plane}),
                  run = FrameFile(path("run.exr"), {}).read({plane});
      EXPECT_EQ(difference(*out.views[0].find(plane), *run.views[0].find(plane)).max, 0) << chosen;
    }
  }
  // Not at another resolution, with normals made of all pixels' depth, or where a mask is to be used.
  for (const Arguments& more :
       {Arguments{"--resolution", "quarter"}, Arguments{"--resolution", "half", "--plane", "normal=none"},
        Arguments{"--resolution", "half", "--mask", "always"}}) {
    Arguments words = {"--budget", "1000s", "--preset", "low"};
    words.insert(words.end(), more.begin(), more.end());
    const Result other = automatic(words);
    ASSERT_EQ(other.status, 0) << other.err;
    EXPECT_EQ(other.json()["why"].get<std::string>().find("from the look"), std::string::npos) << other.json()["why"];
  }
}

TEST_F(AutoBudget, ATimeThatNothingFitsNamesTheCheapest) {
  const Result result = automatic({"--budget", "1us"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["goal_met"], false);
  EXPECT_EQ(result.json()["chosen"].size(), 0u);
  const Json effect = effect_of(result.json(), "ambient occlusion");
  EXPECT_EQ(effect["wanted"], true);
  EXPECT_TRUE(effect["runs"].is_null());
  EXPECT_EQ(effect["lost"], effect["change"]);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("nothing fits, so all effects were left out"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("with the cheapest, "), std::string::npos) << result.err;
  // What was left out is not written as if nothing were there.
  const FrameFile file(path("out.exr"), {});
  for (const PlaneSource& source : file.planes()) EXPECT_EQ(source.plane, "depth");
}

TEST_F(AutoBudget, AnErrorThatLeavingAllOutKeepsCostsNothing) {
  const Result result = automatic({"--error", "1000"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["error_goal"], 1000);
  EXPECT_EQ(result.json()["goal_met"], true);
  EXPECT_EQ(result.json()["chosen"].size(), 0u);
}

TEST_F(AutoBudget, AnErrorThatNothingReachesIsTold) {
  const Result result = automatic({"--error", "1e-9"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["goal_met"], false);
  EXPECT_NE(result.err.find("no choice is expected to reach it; the nearest"), std::string::npos) << result.err;
  EXPECT_GE(result.json()["chosen"].size(), 2u);
}

TEST_F(AutoBudget, AnotherTableOfErrorsIsTakenOrRefusedInOneLine) {
  std::ofstream(path("none.json")) << "{}";
  const Arguments words = {"auto", path("frame.exr"), "-o", path("out.exr"), "--budget", "1000s", "--json", "-"};
  const Result refused = gloam(words, {{"GLOAM_EFFECT_ERRORS", path("none.json")}});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
  EXPECT_NE(refused.err.find("is no table of errors (no 'truth')"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(path("out.exr")));
  // One that expects nothing of any effect.
  Json table = Json::parse(slurp(fs::path(GLOAM_SOURCE_DIR) / "data" / "effect_errors.json"));
  for (Json& plane : table["with_truth"])
    for (Json& share : plane) share = 0;
  std::ofstream(path("nothing.json")) << table;
  const Result result = gloam(words, {{"GLOAM_EFFECT_ERRORS", path("nothing.json")}});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["chosen"].size(), 0u) << result.json()["why"];
  EXPECT_EQ(result.json()["goal_met"], true);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("the colour alone is expected to be nearer to the truth"), std::string::npos) << result.err;
}

// What no mask can save is not searched for: the look has found ambient occlusion nearly everywhere.
TEST_F(AutoBudget, NoMaskIsProbedWhereTheLookFindsAnEffectNearlyEverywhere) {
  const Json document = automatic({"--budget", "1000s"}).json();
  const Json effect = effect_of(document, "ambient occlusion");
  EXPECT_EQ(effect["everywhere"], true) << effect;
  EXPECT_GT(effect["share_of_tiles"], 0.8) << effect;
  EXPECT_LT(effect["share_of_tiles"], 1) << effect;
  const Json always = automatic({"--budget", "1000s", "--mask", "always"}).json();
  EXPECT_GT(always["classify_ms"], document["classify_ms"]);
}

TEST_F(AutoBudget, SettingsThatWereAskedForStand) {
  const Result result = automatic({"--budget", "1000s", "--preset", "low", "--resolution", "half"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json all = result.json()["chosen"];
  ASSERT_GT(all.size(), 0u);
  for (const Json& chosen : all) {
    EXPECT_EQ(chosen["preset"], "low");
    EXPECT_EQ(chosen["resolution"], 2);
  }
}

/// The table of the device has two sizes of every option, and the frame's own of what was run.
TEST_F(AutoBudget, TheTableOfSpeedsIsKeptAndMadeAnewWhereItIsOld) {
  const std::map<std::string, std::string> environment = {{"GLOAM_CACHE_DIR", path("cache")}};
  const Arguments words = {"auto", path("frame.exr"), "-o",   path("out.exr"), "--budget", "1000s", "--preset",
                           "low",  "--resolution",    "half", "--json",        "-"};
  const auto table = [&] {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path("cache") / fs::path("speeds"))) files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1u);
    return files.front();
  };
  const Result first = gloam(words, environment);
  ASSERT_EQ(first.status, 0) << first.err;
  const Json times = Json::parse(slurp(table())).at("times");
  EXPECT_GE(times.size(), 4u) << times;
  for (const auto& [label, sizes] : times.items()) EXPECT_GE(sizes.size(), 2u) << label << sizes;
  std::ofstream(table()) << "{\"ns_per_pixel\": {\"evidence, low, half\": 1}}";
  const Result again = gloam(words, environment);
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.err, first.err);
  EXPECT_EQ(Json::parse(slurp(table())).at("times").size(), times.size());
}

TEST_F(AutoBudget, TwoEyesAreWeighedTogether) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("eyes.exr"), "--size", "128x72", "--stereo", "0.065"}).status, 0);
  const Result result = automatic({"--budget", "1000s"}, "eyes.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result.json(), "ambient occlusion")["runs"], "stereo-evidence");
  EXPECT_EQ(effect_of(result.json(), "reflections")["runs"], "stereo-ssr");
}

// The first frame decides for all, and a frame alone with these settings has the same bits.
TEST_F(AutoBudget, AShotTakesOverWhatTheFirstFrameChooses) {
  ASSERT_EQ(
      gloam({"capture", "gallery", "-o", path("s.####.exr"), "--shot", "walk", "--frames", "1-3", "--size", "192x108"})
          .status,
      0);
  const Result result = gloam({"auto", path("s.####.exr"), "-o", path("o.####.exr"), "--budget", "0.001fps", "--radius",
                               "0.5", "--preset", "low", "--resolution", "half", "--float"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("low, half in all frames, as chosen on the first"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("from the look"), std::string::npos) << result.err;  // the other frames are not looked at
  int compared = 0;
  for (const auto& [technique, plane] :
       std::map<std::string, std::string>{{"evidence", "ao"}, {"indirect", "indirect"}, {"sssr", "reflection"}}) {
    const FrameFile made(path("o.0003.exr"), {});
    const auto is_it = [&, &plane = plane](const PlaneSource& source) { return source.plane == plane; };
    if (std::none_of(made.planes().begin(), made.planes().end(), is_it)) continue;
    ASSERT_EQ(gloam({"run", technique, path("s.0003.exr"), "-o", path("run.exr"), "--preset", "low", "--resolution",
                     "half", "--radius", "0.5", "--float"})
                  .status,
              0);
    const Frame out = FrameFile(path("o.0003.exr"), {}).read({plane}),
                run = FrameFile(path("run.exr"), {}).read({plane});
    EXPECT_EQ(difference(*out.views[0].find(plane), *run.views[0].find(plane)).max, 0) << plane;
    ++compared;
  }
  EXPECT_GE(compared, 1);
}

TEST_F(AutoBudget, AfterACutTheNextFrameChooses) {
  ASSERT_EQ(
      gloam({"capture", "gallery", "-o", path("s.####.exr"), "--shot", "walk", "--frames", "1-3", "--size", "96x54"})
          .status,
      0);
  for (const int number : {4, 5})
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path(fmt::format("s.{:04}.exr", number)), "--size", "96x54", "--eye",
                     fmt::format("{},1.6,-3", 1.5 + 0.01 * number), "--target", "0,1,0"})
                  .status,
              0);
  const Arguments words = {"auto", path("s.####.exr"), "-o",  path("o.####.exr"), "--budget", "0.001fps", "--radius",
                           "0.5",  "--preset",         "low", "--resolution",     "half"};
  const Result result = gloam(words);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("note: frame 4: the camera jumps, so that what is computed is chosen anew\n"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("low, half in frames 1-3, as chosen on the first"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("frames 4-5"), std::string::npos) << result.err;
  // What is there already was made by the choice that holds for it.
  Arguments again = words;
  again.push_back("--resume");
  fs::remove(path("o.0002.exr"));
  const Result resumed = gloam(again);
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("reflections: wanted in 1 of 1 frames computed: sssr in 2\n"), std::string::npos)
      << resumed.err;
}

TEST_F(AutoBudget, AnEnvironmentTakesThePlaceOfAmbientLight) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("lit.exr"), "--sky", path("sky.exr"), "--size", "96x54", "--planes",
                   "normal,color,ambient,albedo"})
                .status,
            0);
  const Result result = automatic({"--budget", "1000s", "--set", "environment=" + path("sky.exr").string()}, "lit.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result.json(), "light of an environment")["runs"], "environment");
  EXPECT_EQ(effect_of(result.json(), "ambient occlusion")["change"], 0);
  EXPECT_TRUE(effect_of(result.json(), "ambient occlusion")["runs"].is_null());
  EXPECT_EQ(effect_of(automatic({"--budget", "1000s"}, "lit.exr").json(), "light of an environment")["wanted"], false);
}

TEST_F(AutoBudget, WhatIsWrongIsSaidInOneLine) {
  const auto message = [&](const Arguments& more, const char* frame = "frame.exr") {
    const Result result = automatic(more, frame);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    return result.err;
  };
  EXPECT_NE(message({"--budget", "30"}).find("write a number with its unit, such as 30ms"), std::string::npos);
  EXPECT_NE(message({"--budget", "-3ms"}).find("--budget"), std::string::npos);
  EXPECT_NE(message({"--budget", "ms"}).find("--budget"), std::string::npos);
  EXPECT_NE(message({"--budget", "60Hz"}).find("--budget 60Hz is not allowed; write a number with its unit"),
            std::string::npos);
  // The frame does not say how much of its colour is ambient light, and has no glossy surfaces.
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("matte.exr"), "--size", "64x36", "--planes", "normal,color,albedo"})
                .status,
            0);
  EXPECT_NE(message({"--budget", "1ms", "--set", "environment=sky.exr"}, "matte.exr")
                .find("is for light of an environment, which falls away: "),
            std::string::npos);
  EXPECT_NE(message({"--error", "0"}).find("--error"), std::string::npos);
  EXPECT_NE(message({"--error", "0.1", "--budget", "1ms"}).find("--budget"), std::string::npos);
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("grey.exr"), "--size", "64x36", "--planes", "depth,normal"}).status,
            0);
  EXPECT_NE(message({"--budget", "30ms"}, "grey.exr").find("needs the frame's colour"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::auto_budget_test
