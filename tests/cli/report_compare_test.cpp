// gloam report A B --compare: on results with noise as a busy machine makes it, and a known change.
#include <cmath>

#include "base/random.h"
#include "cli/gloam_process.h"

namespace gloam::test::report_compare_test {
namespace {

using Json = nlohmann::json;

constexpr int processes = 3, rounds = 7;

double normal(Random& random) {
  const double u = random.uniform(0x1p-53, 1), angle = random.uniform(0, 6.283185307179586);
  return std::sqrt(-2 * std::log(u)) * std::cos(angle);
}

/// A result of twelve techniques with three presets on two scenes: 72 rows. `change`: what the time of a technique is multiplied by;
/// "reference" is HBAO+ itself.
class Bench {
 public:
  explicit Bench(uint64_t seed) : random_(seed) {}
  Bench& times(const std::string& technique, double by) {
    changes_[technique] = by;
    return *this;
  }
  Json made() {
    Json document = {{"device", "a device"}, {"driver", "a driver"}, {"cpu", "a CPU"},          {"cores", 2},
                     {"date", "2026-11-25"}, {"commit", "0123abc"},  {"rounds", rounds},        {"rays", 64},
                     {"gloam", "0.1.0"},     {"set", nullptr},       {"results", Json::array()}};
    document["command"] = {"gloam", "bench"};
    for (const char* scene : {"hall", "field"}) {
      document["scenes"].push_back({{"name", scene}, {"size", {48, 32}}, {"radius", 0.5}, {"truth_noise", 0.01}});
      for (int technique = 0; technique < 12; ++technique) {
        for (const char* preset : {"low", "medium", "high"})
          document["results"].push_back(row(scene, "technique" + std::to_string(technique), preset));
      }
    }
    return document;
  }

 private:
  double change_of(const std::string& what) const {
    const auto found = changes_.find(what);
    return found == changes_.end() ? 1 : found->second;
  }

  Json row(const std::string& scene, const std::string& technique, const std::string& preset) {
    Json ms = Json::array(), ratios = Json::array(), to_gather = Json::array();
    for (int process = 0; process < processes; ++process) {
      const double own = 0.004 * normal(random_), floor = 0.004 * normal(random_);
      for (int round = 0; round < rounds; ++round) {
        const double reference = 2 * change_of("reference"), busy = std::exp(0.2 * std::fabs(normal(random_)));
        const double mine = 3 * change_of(technique) * std::exp(own + 0.01 * normal(random_));
        ms.push_back(mine * busy);
        ratios.push_back(mine / reference);
        to_gather.push_back(mine / std::exp(floor + 0.01 * normal(random_)));
      }
    }
    Json row = {{"technique", technique},
                {"preset", preset},
                {"variant", ""},
                {"scene", scene},
                {"effect", "ao"},
                {"width", 48},
                {"height", 32},
                {"rmse_to_truth", 0.1},
                {"ms", {{"median", 3}, {"min", 3}, {"max", 4}, {"rounds", ms}}}};
    row["processes"] = std::vector<int>(processes, rounds);
    row["ratio_to_hbao_plus_rounds"] = ratios;
    row["ratio_to_gather_floor_rounds"] = to_gather;
    return row;
  }

  Random random_;
  std::map<std::string, double> changes_;
};

/// One line that says what and what to do.
void expect_line(const Result& result, int status, const std::string& what, const std::string& more) {
  EXPECT_EQ(result.status, status) << result.out;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(more), std::string::npos) << result.err;
}
void expect_fails(const Result& result, const std::string& what, const std::string& more) {
  expect_line(result, 1, what, more);
}

class ReportCompare : public Cli {
 protected:
  void write(const std::string& name, const Json& document) const { std::ofstream(path(name)) << document.dump(); }

  Result compare(const Json& before, const Json& after, const Arguments& more = {}) const {
    write("before.json", before);
    write("after.json", after);
    Arguments arguments = {"report", path("before.json"), path("after.json"), "--compare"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }

  Json compared(const Json& before, const Json& after) const {
    const Result result = compare(before, after, {"--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  }

  /// How many rows have a verdict, those of one technique or of all.
  static int count(const Json& document, const char* of, const std::string& verdict,
                   const std::string& technique = "") {
    int found = 0;
    for (const Json& row : document["rows"])
      found += row[of] == verdict && (technique.empty() || row["technique"] == technique);
    return found;
  }

  static Json technique_in(const Json& document, const std::string& name) {
    for (const Json& each : document["techniques"]) {
      if (each["technique"] == name) return each;
    }
    return {};
  }
};

TEST_F(ReportCompare, CallsNothingOfOneBuildFasterOrSlower) {
  const Json document = compared(Bench(1).made(), Bench(2).made());
  ASSERT_EQ(document["rows"].size(), 72u);
  EXPECT_EQ(count(document, "time", "faster") + count(document, "time", "slower"), 0);
  EXPECT_GT(count(document, "time", "same"), 60);
  EXPECT_EQ(count(document, "error", "same"), 72);
  EXPECT_EQ(document["reference"], "hbao+ medium");
  EXPECT_EQ(document["times_of"], "ms");
}

TEST_F(ReportCompare, FindsAKernelThatIsFivePercentSlower) {
  const Json document = compared(Bench(1).made(), Bench(3).times("technique3", 1.05).made());
  EXPECT_GE(count(document, "time", "slower", "technique3"), 5);
  EXPECT_EQ(count(document, "time", "slower"), count(document, "time", "slower", "technique3"));
  EXPECT_EQ(count(document, "time", "faster"), 0);
  const Json technique = technique_in(document, "technique3");
  EXPECT_EQ(technique["time"], "slower");
  EXPECT_NEAR(technique["change"]["value"], 0.05, 0.01);
  EXPECT_LE(technique["change"]["interval"][0], 0.05);
  EXPECT_GE(technique["change"]["interval"][1], 0.05);
  const Json back = compared(Bench(3).times("technique3", 1.05).made(), Bench(1).made());
  EXPECT_EQ(technique_in(back, "technique3")["time"], "faster");
}

TEST_F(ReportCompare, PrefersWhatTheCoresSpent) {
  Json before = Bench(1).made(), after = Bench(2).made();
  for (Json* document : {&before, &after}) {
    for (Json& row : (*document)["results"]) {
      row["cpu_ratio_to_hbao_plus_rounds"] = row["ratio_to_hbao_plus_rounds"];
      // As if a long plan had waited for other programs.
      if (document == &after) {
        for (Json& ratio : row["ratio_to_hbao_plus_rounds"]) ratio = 3 * double(ratio);
      }
    }
  }
  const Json document = compared(before, after);
  EXPECT_EQ(document["times_of"], "cpu_ms");
  EXPECT_EQ(count(document, "time", "slower"), 0);
}

TEST_F(ReportCompare, SaysWhichErrorsAreNearerAndFarther) {
  Json after = Bench(2).made();
  after["results"][0]["rmse_to_truth"] = 0.1 * 1.00005;
  after["results"][1]["rmse_to_truth"] = 0.1 * 1.002;
  after["results"][2]["rmse_to_truth"] = 0.1 * 0.998;
  after["results"][3]["rmse_to_truth"] = nullptr;
  const Json document = compared(Bench(1).made(), after);
  EXPECT_EQ(document["rows"][0]["error"], "same");
  EXPECT_EQ(document["rows"][1]["error"], "farther");
  EXPECT_EQ(document["rows"][2]["error"], "nearer");
  EXPECT_EQ(document["rows"][3]["error"], "not compared");
  after["results"][0]["rmse_to_truth"] = 0.1 * 1.0005;
  EXPECT_EQ(compared(Bench(1).made(), after)["rows"][0]["error"], "farther");
  after["device"] = "another";  // it rounds otherwise
  const Json elsewhere = compared(Bench(1).made(), after);
  EXPECT_EQ(elsewhere["rows"][0]["error"], "same");
  EXPECT_EQ(elsewhere["rows"][1]["error"], "farther");
}

TEST_F(ReportCompare, SaysWhenTheReferenceItselfChanged) {
  const Json document = compared(Bench(1).made(), Bench(2).times("reference", 1.2).made());
  EXPECT_EQ(document["reference"], "the gather floor");
  EXPECT_NEAR(document["reference_change"], std::log(1.2), 0.02);
  EXPECT_EQ(count(document, "time", "faster") + count(document, "time", "slower"), 0);
  ASSERT_EQ(document["notes"].size(), 1u);
  EXPECT_NE(document["notes"][0].get<std::string>().find("hbao+ medium itself changed: +2"), std::string::npos)
      << document["notes"];
}

TEST_F(ReportCompare, ListsRowsOfOneFileAlone) {
  Json before = Bench(1).made(), after = Bench(2).made();
  before["results"].erase(0);
  after["results"][5]["variant"] = "half";
  const Json document = compared(before, after);
  EXPECT_EQ(document["rows"].size(), 70u);
  ASSERT_EQ(document["only_in_first"].size(), 1u);
  EXPECT_EQ(document["only_in_first"][0]["technique"], "technique1");
  ASSERT_EQ(document["only_in_second"].size(), 2u);
  EXPECT_EQ(document["only_in_second"][1]["variant"], "half");
  const Result result = compare(before, after);
  EXPECT_NE(result.out.find("before.json: technique1 high on hall\n"), std::string::npos) << result.out;
}

TEST_F(ReportCompare, PrintsWhatDiffersAndCountsTheRest) {
  Json after = Bench(3).times("technique3", 1.3).made();
  after["results"][0]["rmse_to_truth"] = 0.12;
  const Result result = compare(Bench(1).made(), after, {"--markdown", path("page.md")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* words : {"before.json: commit 0123abc, 2026-11-25, a CPU (a device), 72 rows",
                            "times: ratios within rounds to hbao+ medium, of milliseconds", "0.1000 to 0.1200",
                            "field: time 3 slower and 33 same; error 36 same"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  EXPECT_EQ(result.out.find("technique7 low"), std::string::npos);
  const std::string page = slurp(path("page.md"));
  for (const char* words : {"# Two runs compared", "## Techniques", "## Rows", "technique7", "slower"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(ReportCompare, SaysWhatCanStillBeCompared) {
  Json other = Bench(2).made();
  other["device"] = "another device";
  Result result = compare(Bench(1).made(), other);
  EXPECT_NE(result.err.find("devices differ (a device, a driver and another device, a driver): ratios are compared"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.out.find("ms on a device"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("ms on another device"), std::string::npos) << result.out;
  EXPECT_EQ(compare(Bench(1).made(), Bench(2).made()).out.find("ms on"), std::string::npos);
  other["scenes"][1]["radius"] = 1;
  const std::string out = compare(Bench(1).made(), other).out;
  const size_t table = out.find("ms on another device"), end = out.find("\n\n", table);
  EXPECT_NE(out.substr(table, end - table).find("\nhall"), std::string::npos) << out;
  EXPECT_EQ(out.substr(table, end - table).find("\nfield"), std::string::npos) << out;
  other = Bench(2).made();
  other["driver"] = "another driver";
  EXPECT_NE(compare(Bench(1).made(), other).out.find("ms in "), std::string::npos);
  other = Bench(2).made();
  other["rays"] = 256;
  Json document = compared(Bench(1).made(), other);
  EXPECT_EQ(count(document, "error", "not compared"), 72);
  EXPECT_EQ(count(document, "time", "not compared"), 0);
  EXPECT_EQ(document["notes"][0], "truths differ (rays: 64 and 256): errors are not compared; times are");
  other = Bench(2).made();
  other["scenes"][1]["radius"] = 1;
  document = compared(Bench(1).made(), other);
  EXPECT_EQ(count(document, "time", "not compared"), 36);
  EXPECT_EQ(count(document, "error", "not compared"), 36);
  EXPECT_EQ(document["notes"][0], "the radius differs on field: rows of other work, not compared");
}

TEST_F(ReportCompare, ComparesErrorsWhereNoRoundsAreKept) {
  Json older = Bench(1).made();
  for (Json& row : older["results"]) {
    row.erase("ratio_to_hbao_plus_rounds");
    row["ms"].erase("rounds");
  }
  const Json document = compared(older, Bench(2).made());
  EXPECT_EQ(count(document, "time", "not compared"), 72);
  EXPECT_EQ(count(document, "error", "same"), 72);
  EXPECT_TRUE(document["reference"].is_null());
  EXPECT_NE(document["notes"][0].get<std::string>().find("before.json: keeps no rounds"), std::string::npos)
      << document["notes"];
}

TEST_F(ReportCompare, RefusesResultsThatShareNoFrames) {
  Json set = Bench(2).made();
  set["set"] = {{"name", "gloam-1"}, {"part", "public"}, {"seed", nullptr}, {"hash", "0123456789abcdef"}};
  Json another = set;
  another["set"]["hash"] = "fedcba9876543210";
  expect_fails(compare(Bench(1).made(), set), "before.json is of no set and ",
               "after.json of gloam-1 (public part, hash 0123456789ab): frames of the same name differ");
  expect_fails(compare(set, another), "hash fedcba987654", "measure both on one set");
  EXPECT_EQ(compare(set, set).status, 0);
}

TEST_F(ReportCompare, RefusesFilesThatAreNoResults) {
  write("before.json", Bench(1).made());
  const std::string text = Bench(2).made().dump();
  std::ofstream(path("after.json")) << text.substr(0, text.size() / 2);
  const auto report = [&](const Arguments& files) {
    Arguments arguments = {"report"};
    for (const std::string& file : files) arguments.push_back(path(file));
    arguments.push_back("--compare");
    return gloam(arguments);
  };
  expect_fails(report({"before.json", "after.json"}), "after.json: is not JSON: ", "parse error at line 1");
  expect_fails(report({"before.json", "gone.json"}), "gone.json: is neither a folder nor a file", "gloam bench -o DIR");
  expect_line(report({"before.json"}), 2, "--compare: takes two results", "one is given");
  Json twice = Bench(1).made();
  twice["results"].push_back(twice["results"][0]);
  expect_fails(compare(Bench(1).made(), twice), "after.json: holds technique0 low on hall twice", "one run each");
  Json others = Bench(1).made();
  for (Json& row : others["results"]) row["width"] = 96;
  expect_fails(compare(Bench(1).made(), others), "share no row", "--baseline");
}

}  // namespace
}  // namespace gloam::test::report_compare_test
