// gloam bench and pick within a time: what is measured, and what they say of the rest. No time is asserted.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "cli/gloam_process.h"

namespace gloam::test::bench_time_test {
namespace {

using Json = nlohmann::json;

using Setting = std::tuple<std::string, std::string, std::string>;

class BenchTime : public Cli {
 protected:
  Result bench(const Arguments& more) {
    Arguments arguments = {"bench",      "-o",           path("out"), "--frame",   loggia,       "--truth",
                           loggia_truth, "--techniques", "gtao,hbao", "--presets", "low,medium", "--variants",
                           "half",       "--no-images",  "--json",    "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
};

std::map<Setting, double> errors_of(const Json& document) {
  std::map<Setting, double> errors;
  for (const Json& row : document["results"])
    errors[{row["technique"], row["preset"], row["variant"]}] = row["rmse_to_truth"];
  return errors;
}

std::set<std::string> kinds_of(const Json& left_out) {
  std::set<std::string> kinds;
  for (const Json& each : left_out) kinds.insert(each["what"].get<std::string>());
  return kinds;
}

TEST_F(BenchTime, WithTimeEnoughEverythingIsMeasured) {
  const Result within = bench({"--time", "1h"}), all = bench({"--all", "--rounds", "1"});
  ASSERT_EQ(within.status, 0) << within.err;
  ASSERT_EQ(all.status, 0) << all.err;
  const Json document = within.json(), whole = all.json();
  EXPECT_EQ(errors_of(document), errors_of(whole));
  EXPECT_EQ(document["results"].size(), 6u);
  EXPECT_EQ(document["growth"].size(), whole["growth"].size());
  EXPECT_EQ(document["scales"], whole["scales"]);
  EXPECT_EQ(document["planes"], whole["planes"]);
  EXPECT_EQ(document["converged"], whole["converged"]);
  EXPECT_EQ(document["time_limit_s"], 3600);
  EXPECT_TRUE(whole["time_limit_s"].is_null());
  EXPECT_TRUE(whole["left_out"].empty());
  // The naive kernels are for --all alone; settings far from the front have no floor of their own.
  for (const std::string& kind : kinds_of(document["left_out"]))
    EXPECT_TRUE(kind == "naive kernels" || kind == "own floor") << kind;
  size_t intervals = 0;
  for (const Json& row : document["results"]) {
    const size_t rounds = row["ms"]["rounds"].size();
    EXPECT_TRUE(rounds == 3 || (rounds >= 6 && rounds <= 30)) << rounds;
    EXPECT_TRUE(row["ssim"].is_number());
    EXPECT_EQ(row["ladder"]["t3"].is_number(), row["variant"] == "") << row["preset"];
    intervals += rounds >= 6;
  }
  EXPECT_GE(intervals, 1u);
}

TEST_F(BenchTime, RoundsMayBeFixed) {
  const Result result = bench({"--time", "1h", "--rounds", "4", "--no-growth", "--no-checks", "--ladder", "none"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  for (const Json& row : document["results"]) EXPECT_EQ(row["ms"]["rounds"].size(), 4u);
}

TEST_F(BenchTime, WhatIsLeftOutIsSaidAndShownInTheReport) {
  // A limit that is over while settings are looked at: some, or all, are left out.
  const Result result = bench({"--time", "0.4s"});
  if (result.status != 0) {
    EXPECT_NE(result.err.find("--time 0 s: nothing could be measured in that time"), std::string::npos) << result.err;
    return;
  }
  const Json document = result.json();
  ASSERT_FALSE(document["left_out"].empty());
  for (const char* key : {"technique", "preset", "variant", "scene", "effect", "what"})
    EXPECT_TRUE(document["left_out"][0].contains(key));
  EXPECT_TRUE(kinds_of(document["left_out"]).count("growth"));
}

TEST_F(BenchTime, NothingInNoTimeIsAnError) {
  const Result result = bench({"--time", "0.001s"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("nothing could be measured in that time"), std::string::npos) << result.err;
}

TEST_F(BenchTime, OtherTimesAreRefused) {
  for (const char* time : {"10q", "0", "0s", "-1m", "1m1m", "m", "1m30", "", "nan", "inf"}) {
    const Result result = bench({"--time", time});
    EXPECT_EQ(result.status, 2) << time;
    EXPECT_NE(result.err.find("--time"), std::string::npos) << result.err;
  }
  EXPECT_EQ(bench({"--time", "1m", "--all"}).status, 2);
  // Where everything is measured a limit would have no effect.
  for (const Arguments& all : {Arguments{"--sequence", "walk"},
                               {"--set", "small"},
                               {"--rows", "b.json"},
                               {"--baseline", "b.json"},
                               {"--processes", "2"}}) {
    Arguments arguments = {"bench", "-o", path("out"), "--time", "1m"};
    arguments.insert(arguments.end(), all.begin(), all.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << all.front();
    EXPECT_NE(result.err.find("--time"), std::string::npos) << result.err;
  }
  EXPECT_EQ(gloam({"pick", "f.####.exr", "--truth", "t.####.exr", "--budget", "20ms", "--time", "1m"}).status, 2);
}

TEST_F(BenchTime, PickLeavesOutWhatAFasterSettingRulesOut) {
  // All are within this error, so what takes longer than the fastest cannot be the cheapest.
  const Result result = gloam({"pick", loggia, "--truth", loggia_truth, "--techniques", "gtao,hbao", "--error", "0.9",
                               "--time", "1h", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_TRUE(document["notes"].empty());
  for (const Json& each : document["left_out"]) {
    EXPECT_NE(each["why"].get<std::string>().find("ms already"), std::string::npos) << each;
    EXPECT_NE(each["preset"], "low");
  }

  const auto is_ultra = [](const Json& each) { return each["technique"] == "gtao" && each["preset"] == "ultra"; };
  EXPECT_TRUE(std::any_of(document["left_out"].begin(), document["left_out"].end(), is_ultra)) << document["left_out"];
}

TEST_F(BenchTime, PickSaysLoudlyThatThereIsNoTruth) {
  const Result result = gloam({"pick", loggia, "--techniques", "gtao", "--error", "0.9", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("NO TRUTH: errors are to converged"), std::string::npos) << result.err;
  ASSERT_EQ(result.json()["notes"].size(), 1u);
}

}  // namespace
}  // namespace gloam::test::bench_time_test
