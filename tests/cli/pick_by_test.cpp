// gloam pick --by: the figure that decides, and truths of one eye and of both.
#include <regex>

#include "cli/gloam_process.h"

namespace gloam::test::pick_by_test {
namespace {

using Json = nlohmann::json;

class PickBy : public Cli {
 protected:
  Json picked(const Arguments& more, const std::string& techniques = "hbao+,gtao,alchemy") const {
    Arguments arguments = {"pick",     loggia, "--truth", loggia_truth, "--techniques", techniques,
                           "--rounds", "1",    "--time",  "1h",         "--json",       "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  }
};

TEST_F(PickBy, TheFigureThatDecidesIsLeastOfAllFinalists) {
  for (const std::string by : {"rmse", "ssim", "flip"}) {
    const Json document = picked({"--budget", "1000s", "--by", by});
    EXPECT_EQ(document.at("by"), by);
    const auto off = [&](const Json& choice) {
      return by == "ssim" ? 1 - double(choice.at("ssim")) : double(choice.at(by));
    };
    ASSERT_GE(document.at("finalists").size(), 4u);
    for (const Json& finalist : document.at("finalists")) {
      EXPECT_LE(off(document), off(finalist)) << by;
      EXPECT_GT(double(finalist.at("ssim")), 0);
      EXPECT_LT(double(finalist.at("ssim")), 1);
      EXPECT_EQ(finalist.contains("flip"), by == "flip");
    }
  }
}

TEST_F(PickBy, TheFiguresAreThoseOfCompare) {
  const Json document = picked({"--budget", "1000s"}, "gtao");
  const Json best = document;
  std::string preset = best.at("preset"), resolution = best.at("resolution");
  preset = preset.substr(0, preset.find(' '));
  ASSERT_EQ(gloam({"run", "gtao", loggia, "-o", path("ao.exr"), "--preset", preset, "--resolution", resolution,
                   "--radius", "0.5"})
                .status,
            0);
  const Json compared = gloam({"compare", path("ao.exr"), loggia_truth, "--json", "-"}).json();
  EXPECT_NEAR(best.at("rmse"), compared.at("rmse"), 1e-6);
  EXPECT_NEAR(best.at("ssim"), compared.at("ssim"), 1e-4);
}

TEST_F(PickBy, TheTableSaysWhatDecided) {
  const Result result = gloam({"pick", loggia, "--truth", loggia_truth, "--techniques", "hbao+", "--rounds", "1",
                               "--budget", "1000s", "--by", "ssim"});
  EXPECT_NE(result.out.find("SSIM decides (--by)"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("RMSE    SSIM"), std::string::npos) << result.out;
}

TEST_F(PickBy, OtherFiguresAreWrongUsage) {
  const Result result = gloam({"pick", loggia, "--budget", "1s", "--by", "ssmi"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("did you mean 'ssim'?"), std::string::npos) << result.err;
}

/// Frames of two eyes, with truths in one file per eye, in one file for both, or of only one eye.
class TruthOfEyes : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(gloam({"capture", "gallery", "--size", "96x54", "--stereo", "0.065", "-o", path("pair.exr")}).status, 0);
    ASSERT_EQ(gloam({"reference", "ao", path("pair.exr"), "--samples", "32", "-o", path("both.exr")}).status, 0);
    for (const char* eye : {"left", "right"}) {
      Frame one = FrameFile(path("both.exr"), ReadOptions{.views = {eye}, .as_stored = true}).read({"ao"});
      one.views[0].name = "";
      one.numbers = {{"aoRadius", 0.5}, {"aoSamples", 32}};
      write_frame(path(std::string("truth_") + eye + ".exr"), one);
    }
  }
  std::string file(const std::string& name) const { return path(name).string(); }
  Result pick(const Arguments& truths) const {
    Arguments arguments = {"pick",     file("pair.exr"), "--techniques", "stereo-gtao", "--rounds", "1",
                           "--budget", "1000s",          "--json",       "-",           "--all"};
    for (const std::string& truth : truths) arguments.insert(arguments.end(), {"--truth", file(truth)});
    return gloam(arguments);
  }
};

TEST_F(TruthOfEyes, TwoFilesAreAsGoodAsOne) {
  const Json one = pick({"both.exr"}).json(), two = pick({"truth_left.exr", "truth_right.exr"}).json();
  std::map<std::string, double> errors;
  for (const Json& finalist : one.at("finalists"))
    errors[std::string(finalist.at("preset")) + std::string(finalist.at("resolution"))] = finalist.at("rmse");
  for (const Json& finalist : two.at("finalists")) {
    const auto same = errors.find(std::string(finalist.at("preset")) + std::string(finalist.at("resolution")));
    if (same == errors.end()) continue;
    EXPECT_NEAR(finalist.at("rmse"), same->second, 1e-6);
  }
  EXPECT_EQ(two.at("error_to"), "the truth");
}

TEST_F(TruthOfEyes, OneEyeIsEnoughAndIsSaid) {
  for (const std::string eye : {"left", "right"}) {
    const Result result = pick({"truth_" + eye + ".exr"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("errors are of " + eye + " alone"), std::string::npos) << result.err;
    const std::string preset = result.json().at("preset"), resolution = result.json().at("resolution");
    ASSERT_EQ(gloam({"run", "stereo-gtao", file("pair.exr"), "-o", file("ao.exr"), "--preset",
                     preset.substr(0, preset.find(' ')), "--resolution", resolution, "--radius", "0.5", "--float",
                     "--keep-depth"})
                  .status,
              0);
    const Json compared = gloam({"compare", file("ao.exr"), file("truth_" + eye + ".exr"), "--json", "-"}).json();
    EXPECT_NEAR(result.json().at("rmse"), compared.at("rmse"), 1e-5) << eye;
  }
  const Result bench = gloam({"bench",        "--all",
                              "--frame",      file("pair.exr"),
                              "--truth",      file("truth_left.exr"),
                              "-o",           file("bench"),
                              "--techniques", "gtao",
                              "--presets",    "low",
                              "--variants",   "none",
                              "--rounds",     "1",
                              "--no-growth",  "--no-checks",
                              "--ladder",     "none"});
  EXPECT_EQ(bench.status, 0) << bench.err;
  const Json document = Json::parse(slurp(path("bench/bench.json")));
  EXPECT_GT(document.at("results").at(0).at("rmse_to_truth"), 0);
}

TEST_F(TruthOfEyes, OneEyeTwiceIsRefused) {
  const Result result = pick({"truth_left.exr", "truth_left.exr"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("is a truth of view 'left', as the one before it"), std::string::npos) << result.err;
}

/// Taken from the header; none if the header does not state it.
TEST_F(TruthOfEyes, RaysOfATruthThatWasGivenAreWhatItsHeaderSays) {
  for (const bool says : {true, false}) {
    Frame truth = FrameFile(path("both.exr"), ReadOptions{.as_stored = true}).read({"ao"});
    if (says) truth.numbers["aoSamples"] = 96;
    write_frame(path("given.exr"), truth);
    ASSERT_EQ(gloam({"bench",        "--all",
                     "--frame",      file("pair.exr"),
                     "--truth",      file("given.exr"),
                     "-o",           file("bench"),
                     "--techniques", "gtao",
                     "--presets",    "low",
                     "--variants",   "none",
                     "--rounds",     "1",
                     "--no-growth",  "--no-checks",
                     "--ladder",     "none"})
                  .status,
              0);
    const Json document = Json::parse(slurp(path("bench/bench.json")));
    EXPECT_EQ(document.at("rays"), says ? Json(96.0) : Json());
    EXPECT_EQ(document.at("scenes").at(0).at("truth_rays"), says ? Json(96.0) : Json());
    ASSERT_EQ(gloam({"report", file("bench"), "--markdown", file("report.md")}).status, 0);
    // Where lines break depends on the length of the commit's name.
    const std::string page = std::regex_replace(slurp(path("report.md")), std::regex("\\s+"), " ");
    EXPECT_EQ(page.find("96 rays per pixel") != std::string::npos, says) << page.substr(0, 500);
    EXPECT_EQ(page.find("256 rays"), std::string::npos) << page.substr(0, 500);
  }
}

class PickShot : public Cli {
 protected:
  void make_shot() const {
    ASSERT_EQ(gloam({"capture", "gallery", "--shot", "walk", "-o", path("w.####.exr"), "--frames", "1-3", "--size",
                     "64x36", "--planes", "normal,motion"})
                  .status,
              0);
    ASSERT_EQ(gloam({"reference", "ao", path("w.####.exr"), "-o", path("t.####.exr"), "--samples", "32"}).status, 0);
  }
  Result pick(const Arguments& more) const {
    Arguments all = {"pick", path("w.####.exr"), "--truth", path("t.####.exr"), "--techniques", "gtao"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
};

TEST_F(PickShot, TheCalmestWithinTheBudgetIsPicked) {
  make_shot();
  for (const std::string by : {"rmse", "flicker"}) {
    const Result result = pick({"--budget", "1000s", "--by", by, "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json document = result.json();
    ASSERT_EQ(document["settings"].size(), 8u) << "four presets, alone and over time";
    EXPECT_EQ(document["why"].get<std::string>().rfind("the most accurate within 1e+06 ms: gtao, ", 0), 0u)
        << document["why"];
    for (const Json& setting : document["settings"]) EXPECT_LE(double(document[by]), double(setting[by]));
  }
  // The command that it prints makes the shot.
  const std::string said = pick({"--error", "0.5"}).out;
  const std::string command = said.substr(said.rfind("gloam run"));
  EXPECT_EQ(
      std::system(
          ("cd " + path("").string() + " && " + fs::path(program).parent_path().string() + "/" + command).c_str()),
      0)
      << command;
  EXPECT_TRUE(fs::exists(path("ao.0003.exr")));
}

TEST_F(PickShot, FramesThatAreMissingAreLeftOut) {
  make_shot();
  fs::remove(path("w.0002.exr"));
  const Arguments frames = {"--budget", "1000s", "--frames", "1-3"};
  EXPECT_NE(pick(frames).err.find("--missing skip leaves it out"), std::string::npos);
  Arguments skipping = frames;
  skipping.insert(skipping.end(), {"--missing", "skip"});
  EXPECT_EQ(pick(skipping).status, 0) << pick(skipping).err;
}

TEST_F(PickShot, IsRefusedInOneLine) {
  make_shot();
  const auto refused = [&](const Result& result, int status, const std::string& words) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  refused(pick({"--error", "0.00001"}), 1, "--error 1e-05: nothing comes that near to the truth; the nearest is gtao");
  refused(pick({"--budget", "0.0001ms"}), 1, "the fastest is gtao");
  refused(pick({"--budget", "1s", "--by", "flip"}), 2, "--by flip");
  refused(pick({"--budget", "1s", "--frames", "2"}), 2, "is one frame");
  const Arguments one = {"pick", path("w.0001.exr"), "--budget", "1s"};
  const auto with = [&](const Arguments& more) {
    Arguments all = one;
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  };
  refused(with({"--by", "flicker"}), 2, "is of a shot");
  refused(with({"--frames", "1-2"}), 2, "--frames");
}

/// FLIP of a plane of one value is that of the rows of bench and score: of a grey picture.
TEST_F(PickBy, FlipIsThatOfABenchedRow) {
  const Json picked_row = picked({"--budget", "1000s", "--by", "flip"}, "gtao");
  ASSERT_EQ(gloam({"bench", "--all", "-o", path("bench"), "--frame", loggia, "--truth", loggia_truth, "--rounds", "1",
                   "--variants", "half", "--techniques", "gtao", "--ladder", "none", "--no-growth", "--no-checks",
                   "--no-images"})
                .status,
            0);
  int compared = 0;
  const Json benched = Json::parse(slurp(path("bench/bench.json")));
  for (const Json& row : benched["results"]) {
    for (const Json& finalist : picked_row["finalists"]) {
      if (finalist["preset"] != row["preset"] || finalist["resolution"] != row["resolution"]) continue;
      EXPECT_NEAR(finalist["flip"], row["flip"], 1e-6) << row["preset"] << row["resolution"];
      ++compared;
    }
  }
  EXPECT_GE(compared, 2);
}

}  // namespace
}  // namespace gloam::test::pick_by_test
