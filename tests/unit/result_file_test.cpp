// One bench.json that many processes add to.
#include "score/result_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <set>

#include "base/files.h"
#include "measure/pictures.h"
#include "support/long.h"
#include "unit/message_of.h"

namespace gloam::test::result_file_test {
namespace {

namespace fs = std::filesystem;
using score::Json;
using score::ResultFile;
using score::Results;

Json row(const std::string& entry, const std::string& scene, int version) {
  return {{"technique", entry}, {"preset", "submitted"}, {"scene", scene},
          {"effect", "ao"},     {"rmse_to_truth", 0.5},  {"submitted", {{"name", entry}, {"version", version}}}};
}

Json scene(const std::string& name, double radius = 0.5) {
  return {{"name", name}, {"effect", "ao"}, {"size", {64, 36}}, {"radius", radius}, {"truth_image", nullptr}};
}

Json measured(const std::string& technique, const std::string& on) {
  const Json ms = {{"median", 1}, {"min", 1}, {"max", 1}, {"rounds", {1}}};
  const Json of = {{"technique", technique}, {"preset", "low"}, {"scene", on}, {"effect", "ao"}, {"ms", ms}};
  return {{"device", "d"}, {"scenes", Json::array({scene(on)})}, {"results", Json::array({of})}};
}

/// The versions of an entry's rows by their scenes.
std::map<std::string, int> versions(const Json& document, const std::string& entry) {
  std::map<std::string, int> found;
  for (const Json& each : document["results"]) {
    if (each["technique"] == entry) found[each["scene"]] = each["submitted"]["version"];
  }
  return found;
}

class ResultFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-results-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }

  Json document() const { return Json::parse(read_text(folder / "bench.json")); }

  /// Adds rows again and again; after each time all of the entry's rows have to be there. For a process: returns its exit status.
  int add_rows(const std::string& entry, int merges) const {
    constexpr int scenes = 3;
    std::map<std::string, int> expected;
    const ResultFile file(folder, {});
    for (int i = 0; i < merges; ++i) {
      const std::string name = "scene" + std::to_string(i % scenes);
      file.update([&](Results& results) { results.put(row(entry, name, i), scene(name)); });
      expected[name] = i;
      if (versions(document(), entry) != expected) return 1;
    }
    return 0;
  }

  fs::path folder;
};

TEST_F(ResultFiles, EightProcessesLoseNothing) {
  constexpr int processes = 8;
  const int merges = is_long_run() ? 1250 : 25;
  std::vector<pid_t> children;
  for (int i = 0; i < processes; ++i) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    int status = 2;
    try {
      status = add_rows("m" + std::to_string(i), merges);
    } catch (const std::exception& error) {
      std::fputs(error.what(), stderr);
    }
    _exit(status);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const Json all = document();
  EXPECT_EQ(all["results"].size(), size_t(3 * processes));
  EXPECT_EQ(all["scenes"].size(), 3u);
  for (int i = 0; i < processes; ++i) EXPECT_EQ(versions(all, "m" + std::to_string(i)).size(), 3u) << i;
  for (const auto& entry : fs::directory_iterator(folder)) EXPECT_EQ(entry.path().filename(), "bench.json");
}

TEST_F(ResultFiles, WhatIsMeasuredLeavesWhatWasSubmitted) {
  const ResultFile file(folder, {});
  file.update([](Results& results) { results.put(row("other", "room", 1), scene("room")); });
  file.update([](Results& results) { results.put(row("other", "hall", 1), scene("hall")); });
  const ResultFile again(folder, {});
  again.update([](Results& results) { results.put_measured(measured("gtao", "room")); });
  again.update([](Results& results) { results.put_measured(measured("ssao", "room")); });
  const Json all = document();
  EXPECT_EQ(all["device"], "d");
  EXPECT_EQ(all["results"].size(), 3u);
  EXPECT_EQ(all["results"][0]["technique"], "ssao");
  EXPECT_EQ(versions(all, "other"), (std::map<std::string, int>{{"hall", 1}, {"room", 1}}));
  EXPECT_EQ(all["scenes"].size(), 2u);
  EXPECT_EQ(ResultFile(folder, {}).found().measured_rows(), 1u);
}

TEST_F(ResultFiles, AnotherSceneOfThatNameIsRefused) {
  const ResultFile file(folder, {});
  file.update([](Results& results) { results.put(row("other", "room", 1), scene("room")); });
  const std::string before = read_text(folder / "bench.json");
  const auto says = [&](const std::function<void(Results&)>& change) {
    return message_of([&] { file.update(change); });
  };
  const std::string words = "'room' with the radius 0.5, and the new results have 2.0; write them to another folder";
  EXPECT_NE(says([](Results& results) { results.put(row("more", "room", 1), scene("room", 2)); }).find(words),
            std::string::npos);
  EXPECT_NE(says([](Results& results) {
              Json other = measured("gtao", "room");
              other["scenes"][0]["radius"] = 2.0;
              results.put_measured(other);
            }).find(words),
            std::string::npos);
  EXPECT_EQ(read_text(folder / "bench.json"), before);
}

TEST_F(ResultFiles, TwoMeasurementsAtOnceAreRefused) {
  const score::MeasuringAlone first(folder);
  EXPECT_NE(message_of([&] { score::MeasuringAlone second(folder); }).find("another gloam bench measures into it"),
            std::string::npos);
  const ResultFile file(folder, {});
  file.update([](Results& results) { results.put(row("other", "room", 1), scene("room")); });  // does not wait
  EXPECT_EQ(document()["results"].size(), 1u);
}

/// Folders whose bench.json is one file have one lock.
TEST_F(ResultFiles, ALinkToItIsTheSameFile) {
  const ResultFile file(folder, {});
  file.update([](Results& results) { results.put(row("other", "room", 1), scene("room")); });
  fs::create_directory(folder / "link");
  fs::create_symlink(folder / "bench.json", folder / "link/bench.json");
  const score::MeasuringAlone first(folder / "link");
  EXPECT_NE(message_of([&] { score::MeasuringAlone second(folder); }).find("another gloam bench measures into it"),
            std::string::npos);
}

TEST_F(ResultFiles, NamesOfMethodsAreToldApartInFiles) {
  EXPECT_EQ(bench::file_name("gtao"), "gtao");
  EXPECT_EQ(bench::file_name("hbao+"), "hbaoplus");
  std::set<std::string> files;
  const std::vector<std::string> names = {"方法一", "方法二", "my method", "my: method", "x+", "xplus",
                                          ".x",     "_.x",    ""};
  for (const std::string& name : names) files.insert(bench::file_name(name));
  EXPECT_EQ(files.size(), names.size());
}

TEST_F(ResultFiles, MethodsWhoseFilesWouldHaveOneNameAreRefused) {
  const ResultFile file(folder, {});
  file.update([](Results& results) { results.put(row("my-method", "room", 1), scene("room")); });
  const ResultFile again(folder, {});
  EXPECT_EQ(message_of([&] { again.found().check_files_of("my-method"); }), "no error");
  EXPECT_NE(message_of([&] { again.found().check_files_of("my method"); }).find("holds rows of 'my-method'"),
            std::string::npos);
}

TEST_F(ResultFiles, WrongTypesAreOneLineThatNamesThePlace) {
  const auto says = [&](const std::string& text) {
    write_text(folder / "bench.json", text);
    return message_of([&] { ResultFile file(folder, {}); });
  };
  for (const auto& [text, place] : std::vector<std::pair<std::string, std::string>>{
           {"[]", "the document is []"},
           {"{}", "results is missing"},
           {R"({"results": 7})", "results is 7"},
           {R"({"results": [[]]})", "results[0] is []"},
           {R"({"scenes": [{"name": null}], "results": []})", "scenes[0].name is missing"},
           {R"({"scales": "x", "results": []})", "scales is \"x\""},
           {R"({"stability": {"gtao": {"held": -1, "cases": 1e300}}, "results": []})", "stability.gtao.held is -1"},
           {"{", "is not JSON: parse error"}}) {
    const std::string message = says(text);
    EXPECT_NE(message.find(place), std::string::npos) << text << ": " << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
  // A submission of wrong types stays as it is, and others join.
  Json odd = row("other", "room", 1);
  odd["submitted"]["name"] = 0;
  write_text(folder / "bench.json", Json{{"scenes", Json::array()}, {"results", {odd}}}.dump());
  ResultFile(folder, {}).update([](Results& results) { results.put(row("more", "room", 1), scene("room")); });
  EXPECT_EQ(document()["results"].size(), 2u);
}

}  // namespace
}  // namespace gloam::test::result_file_test
