// gloam bench --baseline, --rows, --processes and --google-benchmark: what is measured again, and what fails.
#include <algorithm>
#include <cmath>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::bench_baseline_test {
namespace {

using Json = nlohmann::json;

class BenchBaseline : public Cli {
 protected:
  Result bench(const std::string& folder, const Arguments& more) const {
    Arguments arguments = {"bench", "-o", path(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }

  /// Two presets, one of them in a variant and with other steps, on one scene: four rows.
  Json before(const Arguments& more = {}) const {
    Arguments arguments = {"--size",       "96x54",       "--rays",     "8",          "--scenes",   "courtyard",
                           "--techniques", "hbao+",       "--presets",  "low,medium", "--variants", "half",
                           "--sweep",      "steps=2",     "--rounds",   "6",          "--ladder",   "none",
                           "--no-growth",  "--no-checks", "--no-images"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = bench("before", arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(slurp(path("before/bench.json")));
  }

  void write(const Json& document) const { std::ofstream(path("before/bench.json")) << document.dump(); }

  Result after(const Arguments& more = {}) const {
    Arguments arguments = {"--baseline", path("before/bench.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return bench("after", arguments);
  }

  static std::set<std::string> names_in(const Json& document) {
    std::set<std::string> names;
    for (const Json& row : document["results"])
      names.insert(row["technique"].get<std::string>() + "/" + row["preset"].get<std::string>() + "/" +
                   row["variant"].get<std::string>());
    return names;
  }

  static void scale_ratios(Json& row, double by) {
    for (const auto& [key, value] : row.items()) {
      if (!key.ends_with("_rounds")) continue;
      for (Json& ratio : value) ratio = by * double(ratio);
    }
  }

  static std::string last_line(const Result& result) {
    const std::string text = result.err.substr(0, result.err.size() - 1);
    return text.substr(text.rfind('\n') + 1);
  }
};

TEST_F(BenchBaseline, MeasuresTheSameRowsAndHoldsWhereNothingChanged) {
  const Json earlier = before();
  ASSERT_EQ(earlier["results"].size(), 4u);
  const Result result = after({"--regression", "error", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(names_in(document), names_in(earlier));
  EXPECT_EQ(document["rounds"], 6);
  EXPECT_EQ(document["rays"], earlier["rays"]);
  EXPECT_TRUE(document["growth"].empty());
  ASSERT_EQ(document["comparison"]["rows"].size(), 4u);
  for (const Json& row : document["comparison"]["rows"]) EXPECT_EQ(row["error"], "same") << row;
  for (size_t i = 0; i < 4; ++i)
    EXPECT_EQ(document["results"][i]["rmse_to_truth"], earlier["results"][i]["rmse_to_truth"]);
}

TEST_F(BenchBaseline, FailsOnAnErrorThatGrew) {
  Json earlier = before();
  Json& rmse = earlier["results"][0]["rmse_to_truth"];
  rmse = 0.9 * rmse.get<double>();
  write(earlier);
  const Result result = after({"--regression", "error"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(last_line(result).find(
                "gloam: worse than before/bench.json: 1 row farther (hbao+ low on courtyard); gloam report "),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.out.find("farther"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(path("after/bench.json")));
}

TEST_F(BenchBaseline, FailsOnATimeThatGrewUnlessErrorsAloneCount) {
  Json earlier = before();
  // So much that no load hides it: rounds of a picture this small differ by tens of per cent beside other work.
  scale_ratios(earlier["results"][1], 1e-60);
  write(earlier);
  const Result result = after({"--regression", "time"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(last_line(result).find("slower (hbao+ medium on courtyard"), std::string::npos) << result.err;
  const Result errors = after({"--regression", "error"});
  EXPECT_EQ(errors.status, 0) << errors.err;
}

TEST_F(BenchBaseline, MeasuresInSeveralProcesses) {
  fs::create_directories(path("before/process-2"));
  std::ofstream(path("before/process-2/notes.txt")) << "mine";
  const Json document = before({"--processes", "2"});
  EXPECT_EQ(document["processes"], 2);
  for (const Json& row : document["results"]) {
    EXPECT_EQ(row["processes"], Json({6, 6}));
    std::vector<double> rounds = row["ratio_to_hbao_plus_rounds"];
    ASSERT_EQ(rounds.size(), 12u);
    EXPECT_EQ(row["ms"]["rounds"].size(), 12u);
    std::sort(rounds.begin(), rounds.end());
    EXPECT_NEAR(row["ratio_to_hbao_plus"], (rounds[5] + rounds[6]) / 2, 1e-12);
    EXPECT_TRUE(row["ms"]["interval"].is_array() || row["ms"]["interval"].is_null());
  }
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(path("before"))) left.insert(entry.path().filename().string());
  EXPECT_EQ(left, (std::set<std::string>{"bench.json", "process-2", "scenes"}));
  EXPECT_EQ(slurp(path("before/process-2/notes.txt")), "mine");
  // The baseline's number of processes is that of the comparison, unless another is given.
  ASSERT_EQ(after({"--regression", "error"}).status, 0);
  EXPECT_EQ(Json::parse(slurp(path("after/bench.json")))["processes"], 2);
}

/// What lies where frames and truths are kept, and was made by somebody else, is not replaced.
TEST_F(BenchBaseline, LeavesFramesOfTheUser) {
  fs::create_directories(path("own/scenes"));
  const std::string frame = path("own/scenes/plane.exr");
  ASSERT_EQ(gloam({"capture", "plane", "-o", frame, "--size", "32x18"}).status, 0);
  const std::string mine = slurp(frame);
  const Result result = gloam({"bench", "-o", path("own"), "--scenes", "plane", "--size", "48x32", "--techniques",
                               "ssao", "--presets", "low", "--rays", "1", "--rounds", "1"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find(frame + ": is no file that gloam bench made"), std::string::npos) << result.err;
  EXPECT_EQ(slurp(frame), mine);
}

/// Every error names its file.
TEST_F(BenchBaseline, NamesTheLockThatCannotBeMade) {
  fs::create_directories(path("own/.gloam-lock-bench"));
  const Result result = gloam({"bench", "-o", path("own"), "--scenes", "plane", "--size", "48x32", "--techniques",
                               "ssao", "--presets", "low", "--rays", "1", "--rounds", "1"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find(path("own/.gloam-lock-bench").string() + ": cannot be made (Is a directory)"),
            std::string::npos)
      << result.err;
}

TEST_F(BenchBaseline, SaysWhatToDoWithFilesThatCannotBeCompared) {
  const Json earlier = before();
  const auto fails = [&](const Json& document, const char* what, const char* todo, const Arguments& more = {}) {
    write(document);
    const Result result = after(more);
    EXPECT_EQ(result.status, 1) << result.out;
    EXPECT_NE(last_line(result).find(what), std::string::npos) << result.err;
    EXPECT_NE(last_line(result).find(todo), std::string::npos) << result.err;
  };
  Json document = earlier;
  for (Json& row : document["results"]) row.erase("ratio_to_hbao_plus_rounds");
  fails(document, "keeps no rounds", "--regression error fails on errors alone");
  document = earlier;
  document["scenes"][0]["name"] = "my frame";
  for (Json& row : document["results"]) row["scene"] = "my frame";
  fails(document, "was measured on 'my frame', which is no built-in scene",
        "give --frame and --truth as then: gloam bench");
  document = earlier;
  document["set"] = {{"name", "gloam-1"}};
  fails(document, "is of the set gloam-1", "--set DIR says where they are");
  document = earlier;
  for (Json& row : document["results"]) row["technique"] = "gone";
  fails(document, "has no row of a technique that this gloam has", "before/bench.json");
  std::ofstream(path("before/bench.json")) << earlier.dump().substr(0, 999);
  const Result truncated = after();
  EXPECT_EQ(truncated.status, 1);
  EXPECT_NE(truncated.err.find("is not JSON"), std::string::npos) << truncated.err;
  EXPECT_EQ(truncated.lines_of_error(), 1);
}

TEST_F(BenchBaseline, TakesNoFlagsThatChooseOtherRows) {
  for (const Arguments& more :
       std::vector<Arguments>{{"--techniques", "gtao"}, {"--scenes", "plane"}, {"--rows", "x"}}) {
    const Result result = after(more);
    EXPECT_EQ(result.status, 2) << more[0];
    EXPECT_NE(result.err.find("--baseline"), std::string::npos) << result.err;
  }
  EXPECT_EQ(bench("after", {"--regression", "time"}).status, 2);
}

TEST_F(BenchBaseline, WritesWhatReadersOfGoogleBenchmarkNeed) {
  const Json document = before({"--google-benchmark", path("google.json")});
  const Json google = Json::parse(slurp(path("google.json")));
  for (const char* key : {"date", "executable", "num_cpus", "caches", "load_avg", "library_build_type"})
    EXPECT_TRUE(google["context"].contains(key)) << key;
  size_t iterations = 0;
  std::set<std::string> aggregates;
  for (const Json& entry : google["benchmarks"]) {
    for (const char* key : {"name", "run_name", "run_type", "time_unit"}) EXPECT_TRUE(entry[key].is_string()) << key;
    for (const char* key : {"real_time", "cpu_time", "iterations", "repetitions", "threads"})
      EXPECT_TRUE(entry[key].is_number()) << key;
    EXPECT_EQ(entry["time_unit"], "ms");
    if (entry["run_type"] == "iteration") {
      EXPECT_EQ(entry["name"], entry["run_name"]);
      EXPECT_TRUE(entry["rmse_to_truth"].is_number());
      ++iterations;
    } else {
      EXPECT_EQ(entry["run_type"], "aggregate");
      aggregates.insert(entry["aggregate_name"]);
    }
  }
  EXPECT_EQ(iterations, 4u * 6);
  EXPECT_EQ(aggregates, (std::set<std::string>{"mean", "median", "stddev", "cv"}));
  EXPECT_EQ(google["benchmarks"][0]["name"], "courtyard/hbao+/low/96x54");
  EXPECT_EQ(google["benchmarks"][0]["real_time"], document["results"][0]["ms"]["rounds"][0]);
}

}  // namespace
}  // namespace gloam::test::bench_baseline_test
