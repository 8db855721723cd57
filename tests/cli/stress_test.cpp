// gloam stress: findings, output and limits.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <numeric>
#include <regex>
#include <sstream>
#include <thread>

#include "cli/gloam_process.h"
#include "gloam/technique.h"

namespace gloam::test::stress_test {
namespace {

using Json = nlohmann::json;

/// With a build whose techniques have one fault each (tests/faults).
class StressOfFaults : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    program = GLOAM_WITH_FAULTS;
  }
  /// A quick run of one case on one technique.
  Result look(const std::string& technique, const std::string& number, Arguments more = {}) const {
    Arguments arguments = {"stress", technique, "--case", number, "--quick", "--against", "none", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  /// The worst finding beyond its bound.
  static Json first_failure(const Result& result) {
    const Json document = result.json();
    for (const Json& entry : document["cases"]) {
      if (!entry["held"]) return entry;
    }
    return nullptr;
  }
};

struct Fault {
  std::string technique, number, what;
  bool has_place = true;  ///< whether the finding has a pixel
};

TEST_F(StressOfFaults, EachIsFoundByTheCaseThatIsThereForIt) {
  for (const Fault& fault : {Fault{"absolute-epsilon", "3", "another unit"},
                             {"background-unknown", "1", "out of its range"},
                             {"by-lanes", "13", "one lane"},
                             {"beside-the-image", "11", "beside the image"},
                             {"shadows-itself", "2", "distance from open"},
                             {"one-sided", "4", "mirrored"},
                             {"squares-depth", "9", "out of its range"},
                             {"one-camera", "10", "tilted wall"},
                             {"brightens", "15", "brighter", false},
                             {"faultless", "16", "all white", false}}) {  // it computes nothing
    const Result result = look(fault.technique, fault.number);
    EXPECT_EQ(result.status, 1) << fault.technique;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    ASSERT_GT(result.json()["failed"], 0) << fault.technique;
    const Json found = first_failure(result);
    EXPECT_EQ(found["technique"], fault.technique);
    EXPECT_EQ(found["case"], std::stoi(fault.number));
    EXPECT_NE(std::string(found["what"]).find(fault.what), std::string::npos) << found["what"];
    EXPECT_EQ(found["place"] != nullptr, fault.has_place) << fault.technique;
  }
}

TEST_F(StressOfFaults, WithoutAFaultAllIsHeld) {
  const Result result = look("faultless", "1,2,3,4,5,7,8,9,10,11,12,13");
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_EQ(result.json()["failed"], 0);
}

TEST_F(StressOfFaults, AreSeenAgainByTheirTrial) {
  const Result all = look("absolute-epsilon", "3");
  const Json found = first_failure(all);
  const std::string replay = found["replay"];
  const std::string expected =
      "gloam stress absolute-epsilon --case 3 --trial " + std::to_string(int(found["trial"])) + " --quick";
  EXPECT_EQ(replay.substr(0, expected.size()), expected);
  const Result again =
      look("absolute-epsilon", "3", {"--trial", std::to_string(int(found["trial"])), "-o", path("trial")});
  ASSERT_EQ(again.json()["cases"].size(), 1u) << again.out;
  EXPECT_EQ(again.json()["cases"][0]["worst"], found["worst"]);
  EXPECT_EQ(again.json()["cases"][0]["place"], found["place"]);
  // Both images that should be alike, and the input of each.
  int files = 0;
  for (const auto& entry : fs::directory_iterator(path("trial"))) files += entry.path().extension() == ".exr";
  EXPECT_EQ(files, 4);
}

TEST_F(StressOfFaults, ARandomFrameIsShrunk) {
  const Json found = first_failure(look("background-unknown", "1"));
  // One pixel of background is enough.
  EXPECT_NE(std::string(found["place"]["holds"]).find("smallest frame that shows it: 1x1"), std::string::npos)
      << found["place"]["holds"];
}

TEST_F(StressOfFaults, ADriverThatCrashesIsAFindingAndTheNextCaseGoesOn) {
  const Result result = look("crashes", "3,11");
  EXPECT_EQ(result.status, 1);
  const Json document = result.json();
  ASSERT_EQ(document["cases"].size(), 2u) << result.out;
  for (const Json& entry : document["cases"]) {
    EXPECT_NE(std::string(entry["what"]).find("trial 1"), std::string::npos) << entry["what"];
    EXPECT_NE(std::string(entry["what"]).find("signal 11"), std::string::npos) << entry["what"];
  }
}

TEST_F(StressOfFaults, OneThatHangsIsGivenUp) {
  const Result result = look("does-not-end", "11", {"--patience", "8"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(std::string(result.json()["cases"][0]["what"]).find("no sign of life for 8 s"), std::string::npos)
      << result.out;
}

TEST_F(StressOfFaults, APageHasTheFiguresOfARun) {
  const Result result = look("by-lanes", "13", {"--markdown", path("page.md")});
  EXPECT_EQ(result.status, 1);
  const std::string page = slurp(path("page.md"));
  EXPECT_NE(page.find("### Case 13"), std::string::npos);
  EXPECT_NE(page.find("| `by-lanes` | 0.015 **beyond** | 0 | precise: difference to one lane |"), std::string::npos)
      << page;
  // The trial that the page names gives the same figure again.
  const size_t where = page.find("13/", page.find("### Where"));
  ASSERT_NE(where, std::string::npos) << page;
  const std::string trial = page.substr(where + 3, page.find(':', where) - where - 3);
  EXPECT_NE(page.find("--quick --case N --trial N -o FOLDER"), std::string::npos);
  const Json again = look("by-lanes", "13", {"--trial", trial}).json()["cases"];
  EXPECT_TRUE(std::any_of(again.begin(), again.end(), [](const Json& entry) {
    return entry["what"] == "fast: largest difference to one lane" && entry["worst"] > 0.01;
  })) << again;
}

/// A long run keeps its results when somebody or something ends it.
TEST_F(StressOfFaults, AnInterruptedRunKeepsWhatWasDone) {
  const pid_t child = start(
      {"stress", "all", "--case", "11", "--quick", "--against", "none", "--jobs", "1", "--json", path("run.json")});
  for (int i = 0; i < 4000 && !fs::exists(path("run.json")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, SIGINT);
  const Result result = finish(child);
  EXPECT_EQ(result.status, 130);
  // The signal may come between the file and the words that it is there.
  EXPECT_NE(result.err.find("gloam: interrupted; the file of --json "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("holds the techniques that were done\n"), std::string::npos) << result.err;
  const Json document = Json::parse(slurp(path("run.json")));
  const Arguments left = document["left"];
  EXPECT_NE(std::find(left.begin(), left.end(), "does-not-end"), left.end()) << document["left"];
  ASSERT_FALSE(document["cases"].empty());
  for (const Json& entry : document["cases"])
    EXPECT_EQ(std::find(left.begin(), left.end(), entry["technique"]), left.end()) << entry["technique"];

  ASSERT_EQ(gloam({"stress", "--from", path("run.json"), "--markdown", path("page.md")}).status, 0);
  const std::string page = slurp(path("page.md"));
  EXPECT_NE(page.find("- The run was broken off. Not examined: "), std::string::npos) << page.substr(0, 1000);
}

class Stress : public Cli {};

TEST_F(Stress, ATechniqueHoldsACase) {
  const Result result = gloam({"stress", "hbao+", "--case", "3", "--quick", "--against", "none"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("difference to the scene with another unit"), std::string::npos) << result.out;
}

TEST_F(Stress, APageOfEarlierRunsIsTheSamePage) {
  const Result first = gloam({"stress", "normals", "--case", "3,13", "--quick", "--against", "none", "--json",
                              path("run.json"), "--markdown", path("page.md")});
  ASSERT_EQ(first.status, 0) << first.err;
  const Result second = gloam({"stress", "--from", path("run.json"), "--markdown", path("again.md")});
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(slurp(path("page.md")), slurp(path("again.md")));
}

TEST_F(Stress, CasesCanBeListed) {
  const Json cases = gloam({"list", "cases", "--json", "-"}).json();
  std::vector<int> numbers;
  for (const Json& one : cases) numbers.push_back(one["case"]);
  std::vector<int> expected(20);
  std::iota(expected.begin(), expected.end(), 1);
  EXPECT_EQ(numbers, expected);
}

TEST_F(Stress, RefusesWhatItCannotDo) {
  const auto refused = [&](const Arguments& arguments, int status, const std::vector<std::string>& words) {
    Arguments all = {"stress"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(result.out, "");
    for (const std::string& word : words) EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  };
  refused({}, 2, {"which technique", "all"});
  refused({"hbao-"}, 2, {"hbao-", "did you mean"});
  refused({"hbao+", "--case", "21"}, 2, {"no hard case 21", "gloam list cases"});
  refused({"hbao+", "--case", "x"}, 2, {"--case", "x"});
  refused({"hbao+", "--trial", "3"}, 2, {"--trial 3", "--case"});
  refused({"all", "--case", "3", "--trial", "3"}, 2, {"--trial 3"});
  refused({"hbao+", "--case", "3", "--trial", "1000000"}, 2, {"--trial 1000000", "trials"});
  refused({"hbao+", "-o", path("x")}, 2, {"-o", "--trial"});
  refused({"hbao+", "--device", "nonesuch", "--case", "3"}, 1, {"nonesuch"});
  refused({"hbao+", "--patience", "0"}, 2, {"--patience 0"});
  refused({"hbao+", "--jobs", "0"}, 2, {"--jobs 0"});
  refused({"hbao+", "--from", path("x.json")}, 2, {"--from", "hbao+"});
  refused({"--from", path("x.json"), "--markdown", path("y.md")}, 1, {"x.json"});
  refused({"hbao+", "--case", "3", "--json", "/nonexistent/x.json"}, 1, {"/nonexistent"});
  refused({"hbao+", "--case", "3", "--against", "nonesuch"}, 2, {"--against nonesuch", "gloam list devices"});
  refused({"hbao+", "--case", "3", "--frames", "5"}, 2, {"--frames 5", "case 1"});
  refused({"hbao+", "--case", "3", "--trial", "1", "-o", "/proc/x"}, 1, {"-o /proc/x", "cannot be made"});
  refused({"hidden-mask", "--case", "4", "--trial", "1"}, 2, {"--trial 1", "0 trials", "opted out"});
  std::ofstream(path("half.json")) << R"({"device": "a", "cases": []})";
  refused({"--from", path("half.json"), "--markdown", path("y.md")}, 1, {"half.json", "no results"});
}

/// A driver may crash, or write a last line, when its process ends: what the child has refused by then is told all the same.
TEST_F(Stress, IsRefusedHoweverTheDriverEnds) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers have to be loaded first";
#endif
  const std::map<std::string, std::string> driver = {
      {"LD_PRELOAD", (fs::path(GLOAM_WITH_FAULTS).parent_path() / "dies_at_exit.so").string()}};
  for (const auto& [flag, status] : {std::pair("--against", 2), std::pair("--device", 1)}) {
    const Result result = gloam({"stress", "hbao+", "--case", "3", flag, "nonesuch"}, driver);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("nonesuch"), std::string::npos) << result.err;
  }
}

TEST_F(Stress, AnOptOutOfAPartIsSaid) {
  const Arguments look = {"stress", "corner-mask", "--case", "6", "--quick", "--against", "none"};
  Arguments with_json = look;
  with_json.insert(with_json.end(), {"--json", "-"});
  const Json document = gloam(with_json).json();
  ASSERT_EQ(document["opted_out_in_part"].size(), 1u) << document;
  const std::string why = document["opted_out_in_part"][0]["why"];
  EXPECT_EQ(why.substr(0, 20), "normals from depth: ");
  EXPECT_NE(gloam(look).out.find("opted out of " + why), std::string::npos) << why;
}

/// A line with a wrong number, part or name would opt nothing out, unnoticed.
TEST(OptOuts, NameACaseAPartAndATechnique) {
  std::string asked;  // all parts that cases ask for
  for (const auto& entry : fs::directory_iterator(std::string(GLOAM_SOURCE_DIR) + "/host/stress/cases"))
    asked += slurp(entry.path());
  int lines = 0;
  for (const Technique& technique : registry()) {
    const fs::path folder = folder_of(technique);
    std::istringstream page(slurp(fs::path(GLOAM_SOURCE_DIR) / "kernels" / folder / "README.md"));
    for (std::string line; std::getline(page, line);) {
      if (line.rfind("hard case", 0) != 0) continue;
      std::smatch found;
      ASSERT_TRUE(
          std::regex_match(line, found, std::regex(R"(hard case (\d+)(?:, ([^(:]+?))?(?: \(([^)]+)\))?: (.+))")))
          << line;
      const int number = std::stoi(found[1]);
      EXPECT_TRUE(number >= 1 && number <= 20) << line;
      const bool is_part = found[2].matched, is_of_one = found[3].matched;
      EXPECT_TRUE(!is_part || asked.find("opt_out(\"" + found[2].str() + "\")") != std::string::npos) << line;
      EXPECT_TRUE(!is_of_one || folder_of(find_technique(found[3])) == folder) << line;
      ++lines;
    }
  }
  EXPECT_GT(lines, 0);
}

}  // namespace
}  // namespace gloam::test::stress_test
