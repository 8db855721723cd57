// gloam pick: the choice keeps its promise, and runs; no times.
#include <set>
#include <sstream>

#include "cli/gloam_process.h"

namespace gloam::test::pick_test {
namespace {

using Json = nlohmann::json;

Arguments pick(const Arguments& more) {
  Arguments arguments = {"pick", loggia,         "--truth",    loggia_truth, "--rounds",
                         "2",    "--techniques", "gtao,hbao+", "--time",     "1h"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The printed line as arguments, with another output.
Arguments arguments_of(const std::string& command, const fs::path& out) {
  Arguments arguments;
  std::istringstream words(command);
  for (std::string word; words >> word;) arguments.push_back(word);
  EXPECT_EQ(arguments.front(), "gloam");
  arguments.erase(arguments.begin());
  for (std::string& argument : arguments) {
    if (argument == "ao.exr") argument = out.string();
  }
  return arguments;
}

TEST_F(Cli, PickWithinABudgetIsTheMostAccurateAndRuns) {
  const Json document = gloam(pick({"--budget", "100s", "--json", "-"})).json();
  for (const Json& finalist : document["finalists"]) EXPECT_GE(finalist["rmse"], document["rmse"]);
  EXPECT_EQ(document["technique"], "gtao");  // hbao+ fades occluders, and so is far from the truth (docs/accuracy.md)
  EXPECT_EQ(document["error_to"], "the truth");
  const std::string why = document["why"];
  const std::string best =
      fmt::format("gtao, {}, {}", document["preset"].get<std::string>(), document["resolution"].get<std::string>());
  EXPECT_EQ(why.rfind("the most accurate within 100000 ms: " + best + " with ", 0), 0u) << why;
  EXPECT_NE(why.find("; the next faster, "), std::string::npos) << why;
  const fs::path out = folder / "ao.exr";
  ASSERT_EQ(gloam(arguments_of(document["command"], out)).status, 0);
  const Json compared = gloam({"compare", out.string(), loggia_truth, "--json", "-"}).json();
  EXPECT_NEAR(compared["rmse"].get<double>(), document["rmse"].get<double>(), 1e-4);
}

TEST_F(Cli, PickWithinAnErrorIsTheCheapest) {
  const Json document = gloam(pick({"--error", "0.15", "--json", "-"})).json();
  EXPECT_LE(document["rmse"], 0.15);
  for (const Json& finalist : document["finalists"]) {
    if (finalist["rmse"] <= 0.15) {
      EXPECT_GE(finalist["ms"], document["ms"]);
    }
  }
}

TEST_F(Cli, PickSaysWhyAndWhatItDidNotTry) {
  const Result result = gloam({"pick", loggia, "--truth", loggia_truth, "--rounds", "1", "--techniques", "gtao,dp-gtao",
                               "--time", "1h", "--error", "0.15"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::istringstream lines(result.out);
  int whys = 0, not_tried = 0;
  for (std::string line; std::getline(lines, line);) {
    whys += line.rfind("the fastest within RMSE 0.15: gtao, ", 0) == 0;
    if (line.rfind("not tried: ", 0) != 0) continue;
    ++not_tried;
    EXPECT_NE(line.find("settings of dp-gtao, which cannot run here"), std::string::npos) << line;
  }
  EXPECT_EQ(whys, 1) << result.out;
  EXPECT_EQ(not_tried, 1) << result.out;
}

TEST_F(Cli, PickMeasuresOnTheFirstViewWhatMakesNoOther) {
  ASSERT_EQ(
      gloam({"capture", "colonnade", "-o", path("two.exr"), "--size", "48x27", "--stochastic", "4", "--view2", "30"})
          .status,
      0);
  const Result result = gloam({"pick", path("two.exr"), "--budget", "100s", "--all", "--rays", "16", "--rounds", "1",
                               "--techniques", "multiview,hbao+", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_TRUE(document["skipped"].empty()) << document["skipped"];
  std::set<std::string> tried;
  for (const Json& finalist : document["finalists"]) {
    tried.insert(finalist["technique"].get<std::string>());
    EXPECT_GT(finalist["rmse"], 1e-3);
  }
  EXPECT_TRUE(tried.count("multiview")) << Json(tried);
}

TEST_F(Cli, PickWithoutATruthSaysWhatErrorsAreTo) {
  const Result result = gloam({"pick", loggia, "--budget", "100s", "--rounds", "1", "--techniques", "gtao"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("as no truth is at hand"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("gloam run gtao "), std::string::npos) << result.out;
}

TEST_F(Cli, PickNamesAFrameOfAShotOnce) {
  write_frame(path("shot.0001.exr"), small_frame());
  write_frame(path("shot.0002.exr"), small_frame());
  const Result result = gloam({"pick", path("shot.####.exr"), "--budget", "1s", "--techniques", "ssao"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  const size_t first = result.err.find("frame 1:");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("frame 1:", first + 1), std::string::npos) << result.err;
}

TEST_F(Cli, PickRefusesInOneLine) {
  const auto expect_refused = [&](const Arguments& arguments, const std::string& part) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  };
  expect_refused(pick({}), "--budget");
  expect_refused(pick({"--budget", "20ms", "--error", "0.1"}), "give one of them");
  expect_refused(pick({"--budget", "3parsecs"}), "3parsecs");
  expect_refused(pick({"--error", "-1"}), "--error");
  expect_refused({"pick", loggia, "--budget", "20ms", "--techniques", "bilateral"}, "filter");
  const Result fast = gloam(pick({"--budget", "0.0001ms"}));
  EXPECT_EQ(fast.status, 1);
  EXPECT_NE(fast.err.find("nothing is that fast"), std::string::npos) << fast.err;
  const Result rate = gloam(pick({"--budget", "1000000fps"}));
  EXPECT_EQ(rate.status, 1);
  EXPECT_NE(rate.err.find("--budget 1000000fps (0.001 ms): nothing is that fast"), std::string::npos) << rate.err;
  expect_refused(pick({"--budget", "fps"}), "such as 60fps");
  const Result near = gloam(pick({"--error", "0.0001"}));
  EXPECT_EQ(near.status, 1);
  EXPECT_NE(near.err.find("nothing comes that near"), std::string::npos) << near.err;
}

}  // namespace
}  // namespace gloam::test::pick_test
