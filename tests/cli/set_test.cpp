// gloam set: sets that are the same at each making, and verification that finds what is not.
#include <algorithm>
#include <chrono>
#include <thread>

#include "cli/gloam_process.h"
#include "gloam/exr.h"
#include "set/content_hash.h"
#include "set/making.h"
#include "set/manifest.h"
#include "set/recipe.h"

namespace gloam::test::set_test {
namespace {

using nlohmann::json;

class Sets : public Cli {
 protected:
  std::string in(const char* name) const { return path(name).string(); }

  /// Makes items of a set, and returns the document.
  json made(const std::string& set, const char* folder, Arguments more = {},
            const std::map<std::string, std::string>& environment = {}) const {
    Arguments arguments = {"set", "make", set, "-o", in(folder), "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments, environment);
    EXPECT_EQ(result.status, 0) << result.err << result.out;
    return result.status == 0 ? result.json() : json();
  }

  json verified(const char* folder, int status) const {
    const Result result = gloam({"set", "verify", in(folder), "--json", "-"});
    EXPECT_EQ(result.status, status) << result.err << result.out;
    return result.json();
  }

  /// The one problem that is found, as "FILE PROBLEM".
  std::string only_problem(const char* folder) const {
    const json document = verified(folder, 1);
    EXPECT_FALSE(document["held"]);
    EXPECT_EQ(document["problems"].size(), 1u) << document.dump(1);
    const json problem = document["problems"].empty() ? json{{"file", ""}, {"problem", ""}} : document["problems"][0];
    return problem["file"].get<std::string>() + " " + problem["problem"].get<std::string>();
  }

  /// Changes the last bit of one value of a file.
  void change_a_bit(const fs::path& file) const {
    ReadOptions options;
    options.as_stored = true;
    Frame frame = FrameFile(file, options).read({"depth", "ao"});
    float& value = frame.views[0].planes.at("ao").channels[0].at(3, 2);
    value = std::nextafter(value, 2.0f);
    write_frame(file, frame);
  }
};

TEST_F(Sets, AreListedWithTheirItems) {
  const json all = gloam({"set", "list", "--json", "-"}).json();
  ASSERT_EQ(all.size(), sets::recipes().size());
  EXPECT_EQ(all[0]["set"], "gloam-1");
  EXPECT_EQ(all[0]["licence"], "MIT");
  const std::string items = gloam({"set", "list", "gloam-1"}).out;
  for (const char* word : {"courtyard", "gallery-walk", "colonnade-eyes", "statue-display", "hard-corner"})
    EXPECT_NE(items.find(word), std::string::npos) << word;
}

TEST_F(Sets, AreMadeInFoldersNotInFiles) {
  const Result result = gloam({"set", "make", "gloam-1", "-o", in("e.json")});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  for (const char* words : {"e.json: is the folder to make the set in, and looks like a file", "--json FILE"})
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(path("e.json")));
}

TEST_F(Sets, HaveTheFrozenContent) {
  const json first = made("small", "set");
  EXPECT_TRUE(first["complete"]);
  EXPECT_TRUE(first["unfrozen"].empty()) << first["unfrozen"];
  EXPECT_EQ(first["kept"], 0);
  const json again = made("small", "set");
  EXPECT_EQ(again["made"], 0) << "what is there stays";
  EXPECT_EQ(again["kept"], first["made"]);
  EXPECT_EQ(again["hash"], first["hash"]);
  const json found = verified("set", 0);
  EXPECT_TRUE(found["held"]);
  EXPECT_TRUE(found["complete"]);
  EXPECT_EQ(found["hash"], first["hash"]);
  EXPECT_EQ(found["files"], first["made"]);
}

/// A scene, a camera or a reference that changes what gloam-1 holds makes this fail: then gloam-1 stays as it is with its hashes of old,
/// and what changed makes gloam-2.
TEST_F(Sets, OfFiguresHaveTheFrozenContent) {
  const json one = made("gloam-1", "set", {"--only", "gallery-display,hard-step,hard-giant-corner"});
  EXPECT_TRUE(one["unfrozen"].empty()) << one["unfrozen"];
  EXPECT_TRUE(one["differs"].empty()) << one["differs"];
  EXPECT_FALSE(one["complete"]);
  const json found = verified("set", 0);
  EXPECT_FALSE(found["complete"]);
  EXPECT_EQ(found["missing"].size() + 3, sets::find_recipe("gloam-1").items.size());
}

/// What `made` compares is the frozen content, from another machine and other numbers of threads.
TEST_F(Sets, AreTheSameWithOtherThreadsAndInstructions) {
  std::vector<std::map<std::string, std::string>> environments = {
      {{"OMP_NUM_THREADS", "1"}},
      {{"OMP_NUM_THREADS", "5"}},
      {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-AVX512F,-AVX,-SSE4_1"}},
      {{"GLIBC_TUNABLES", "glibc.malloc.check=0:glibc.cpu.hwcaps=-AVX512F"}}};
  // Embree with 4, 8 and 16 lanes, with and without fused multiply-add.
  if (__builtin_cpu_supports("sse4.2")) environments.push_back({{"GLOAM_EMBREE_ISA", "sse4.2"}});
  if (__builtin_cpu_supports("avx2")) environments.push_back({{"GLOAM_EMBREE_ISA", "avx2"}});
  if (__builtin_cpu_supports("avx512vl")) environments.push_back({{"GLOAM_EMBREE_ISA", "avx512"}});
  int number = 0;
  for (const auto& environment : environments) {
    const std::string folder = fmt::format("set{}", number++);
    EXPECT_TRUE(made("small", folder.c_str(), {}, environment)["differs"].empty());
  }
}

TEST_F(Sets, GoOnWhereTheyWereKilled) {
  const pid_t child = start({"set", "make", "small", "-o", in("set")});
  for (int i = 0; i < 80000 && !fs::exists(path("set/frames/gallery.exr")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  finish(child);
  ASSERT_TRUE(fs::exists(path("set/frames/gallery.exr")));
  const json rest = made("small", "set");
  EXPECT_GE(rest["kept"], 1);
  EXPECT_TRUE(rest["complete"]);
  EXPECT_TRUE(verified("set", 0)["held"]);
}

TEST_F(Sets, ArePutTogetherOfPartsThatAreMadeAtOnce) {
  std::vector<pid_t> makers;
  for (const char* item : {"corner", "eyes", "gallery"})
    makers.push_back(start({"set", "make", "small", "-o", in("set"), "--only", item, "-q"}));
  for (const pid_t maker : makers) {
    const Result result = finish(maker);
    EXPECT_EQ(result.status, 0) << result.err;
  }
  EXPECT_EQ(made("small", "set", {"--only", "corner"})["missing"], json({"gears", "display"}));
}

TEST_F(Sets, ArePutTogetherOfParts) {
  made("small", "set", {"--only", "corner"});
  const json both = made("small", "set", {"--only", "eyes"});
  EXPECT_EQ(both["missing"], json({"gallery", "gears", "display"}));
  EXPECT_EQ(made("small", "set")["hash"], made("small", "other")["hash"]);
}

TEST_F(Sets, TellATamperedFile) {
  made("small", "set", {"--only", "eyes,corner"});
  change_a_bit(path("set/truths/corner_ao.exr"));
  const std::string problem = only_problem("set");
  EXPECT_EQ(problem.rfind("truths/corner_ao.exr was changed: its content has the hash ", 0), 0u) << problem;
  const Result result = gloam({"set", "verify", in("set")});
  EXPECT_EQ(result.lines_of_error(), 1);
  EXPECT_EQ(made("small", "set", {"--only", "corner"})["made"], 2) << "closed forms make frame and truth";
  EXPECT_TRUE(verified("set", 0)["held"]);
}

/// A manifest that was made to fit has no longer the frozen hashes.
TEST_F(Sets, TellAnotherVersionOfTheSet) {
  made("small", "set", {"--only", "corner"});
  change_a_bit(path("set/truths/corner_ao.exr"));
  sets::Manifest manifest = sets::read_manifest(path("set"));
  manifest.items[0].truths[0].files[0].sha256 = sets::content_hash(path("set/truths/corner_ao.exr"));
  sets::write_manifest(path("set"), manifest);
  const std::string problem = only_problem("set");
  EXPECT_EQ(problem.rfind("truths/corner_ao.exr is of another version of the set: ", 0), 0u) << problem;
  manifest.set = "gloam-0";
  sets::write_manifest(path("set"), manifest);
  const Result other = gloam({"set", "verify", in("set")});
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("holds the set 'gloam-0', made by gloam "), std::string::npos) << other.err;
  EXPECT_EQ(other.lines_of_error(), 1);
}

TEST_F(Sets, TellMissingAndFurtherAndDamagedFiles) {
  made("small", "set", {"--only", "corner"});
  const fs::path frame = path("set/frames/corner.exr");
  fs::rename(frame, path("set/frames/mine.exr"));
  const json found = verified("set", 1);
  ASSERT_EQ(found["problems"].size(), 2u);
  EXPECT_EQ(found["problems"][0], json({{"file", "frames/corner.exr"}, {"problem", "is missing"}}));
  EXPECT_EQ(found["problems"][1], json({{"file", "frames/mine.exr"}, {"problem", "is not of the set; move it away"}}));
  fs::rename(path("set/frames/mine.exr"), frame);
  fs::resize_file(frame, fs::file_size(frame) / 2);
  EXPECT_NE(only_problem("set").find("frames/corner.exr cannot be read: "), std::string::npos);
}

/// The hash is over what a file holds: how it is compressed is another matter.
TEST_F(Sets, StayTheSameInAnotherCompression) {
  made("small", "set", {"--only", "corner"});
  const fs::path file = path("set/truths/corner_ao.exr");
  const std::string hash = sets::content_hash(file), bytes = slurp(file);
  ReadOptions options;
  options.as_stored = true;
  FrameFile kept(file, options);
  Frame frame = kept.read({"depth", "ao"});
  for (const char* name : {"gloamSet", "aoDefinition"}) frame.attributes[name] = kept.text_attribute(name);
  for (const char* name : {"aoRadius", "aoNoise"}) frame.numbers[name] = kept.number_attribute(name).value();
  frame.views[0].camera->source = kept.text_attribute("gloamCamera");
  WriteOptions write;
  write.compression = "piz";
  write_frame(file, frame, write);
  EXPECT_NE(slurp(file), bytes);
  EXPECT_EQ(sets::content_hash(file), hash);
  EXPECT_TRUE(verified("set", 0)["held"]);
}

TEST_F(Sets, AreDrawnFromASeed) {
  const json one = made("small", "one", {"--seed", "7"}),
             same = made("small", "same", {"--seed", "7"}, {{"OMP_NUM_THREADS", "1"}}),
             other = made("small", "other", {"--seed", "8"});
  EXPECT_EQ(one["part"], "seeded");
  EXPECT_EQ(one["seed"], 7);
  EXPECT_EQ(one["hash"], same["hash"]);
  EXPECT_NE(one["hash"], other["hash"]);
  EXPECT_TRUE(verified("one", 0)["held"]);
  const sets::Manifest manifest = sets::read_manifest(path("one"));
  ASSERT_EQ(manifest.items.size(), 1u) << "of the one scene of the set";
  EXPECT_EQ(manifest.items[0].name, "seeded-gallery");
  EXPECT_EQ(manifest.items[0].truths[0].rays, 128) << "twice those of the public part";
  const Result mixed = gloam({"set", "make", "small", "-o", in("one")});
  EXPECT_EQ(mixed.status, 1);
  EXPECT_NE(mixed.err.find("holds small of seed 7; name another folder, or remove this one"), std::string::npos)
      << mixed.err;
}

TEST_F(Sets, RefuseWhatCannotBe) {
  const std::pair<Arguments, std::string> told[] = {
      {{"set", "mkae"}, "gloam: set: no 'mkae' (did you mean 'make'?); there are list, make and verify\n"},
      {{"set", "make"}, "gloam: set make: needs the name of a set; gloam set list shows them\n"},
      {{"set", "make", "gloam1"},
       "gloam: no set 'gloam1' (did you mean 'gloam-1'?); there are gloam-1 and small (gloam set list)\n"},
      {{"set", "make", "small", "--only", "gallary"},
       "gloam: --only gallary: small has no such item (did you mean 'gallery'?) (gloam set list small)\n"},
      {{"set", "verify"}, "gloam: set verify: needs the folder of a set: gloam set verify DIR\n"},
      {{"set", "verify", "x", "--seed", "3"}, "gloam: set verify: --seed is for gloam set make; leave it out\n"},
      {{"set", "list", "-o", "x"}, "gloam: set list: -o is for gloam set make; leave it out\n"}};
  for (const auto& [arguments, message] : told) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.err, message);
  }
  const Result nothing = gloam({"set", "verify", in("nothing")});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_NE(nothing.err.find(": there is no set: no manifest.json; gloam set make NAME -o DIR makes one"),
            std::string::npos);
}

/// Each file of each item has a hash, and no hash is of another file.
TEST_F(Sets, AreFrozenWholly) {
  for (const sets::Recipe& recipe : sets::recipes()) {
    size_t frozen = 0;
    for (const sets::ItemRecipe& item : recipe.items) {
      std::vector<std::string> files = sets::frame_files(item);
      for (const sets::TruthRecipe& truth : item.truths) {
        for (const std::string& file : sets::truth_files(item, truth.effect)) files.push_back(file);
      }
      const auto has_hash = [&](const std::string& file) { return recipe.hashes.count(file) == 1; };
      const size_t count = size_t(std::count_if(files.begin(), files.end(), has_hash));
      EXPECT_EQ(count, files.size()) << recipe.name << " " << item.name;
      frozen += count;
    }
    EXPECT_EQ(recipe.hashes.size(), frozen) << recipe.name << " has hashes of files that no item has";
    EXPECT_GT(frozen, 0u) << recipe.name;
    EXPECT_FALSE(recipe.frozen_with.empty()) << recipe.name;
  }
}

}  // namespace
}  // namespace gloam::test::set_test
