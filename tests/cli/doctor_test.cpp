// gloam doctor: what it finds, what it keeps, and what becomes of kept kernels that are damaged.
#include "cli/gloam_process.h"

namespace gloam::test::doctor_test {
namespace {

/// Replaces each occurrence of some bytes; returns how many there were.
int replace_bytes(const fs::path& file, const std::string& from, const std::string& to) {
  std::string bytes = slurp(file);
  int count = 0;
  for (size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + to.size()), ++count)
    bytes.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << bytes;
  return count;
}

class Doctor : public Cli {
 protected:
  /// A cache folder of gloam for this test alone.
  std::map<std::string, std::string> environment(std::map<std::string, std::string> more = {}) const {
    more.emplace("GLOAM_CACHE_DIR", path("cache").string());
    return more;
  }
  Result doctor(const Arguments& flags, const std::map<std::string, std::string>& more = {}) const {
    Arguments all = {"doctor"};
    all.insert(all.end(), flags.begin(), flags.end());
    return gloam(all, environment(more));
  }
  std::vector<fs::path> kept(const fs::path& below, const std::string& ending) const {
    std::vector<fs::path> found;
    if (!fs::exists(below)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(below))
      if (entry.path().extension() == ending) found.push_back(entry.path());
    return found;
  }
  /// The device that runs use by default, which need not be listed first; other drivers of the machine are left alone.
  std::string default_device() const {
    const Result run = gloam({"run", "normals", loggia, "-o", path("any.exr"), "--json", "-"}, environment());
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json()["device"];
  }
  nlohmann::json listed(const std::string& device) const {
    for (const nlohmann::json& entry : gloam({"list", "devices", "--json", "-"}, environment()).json())
      if (entry["device"] == device) return entry;
    ADD_FAILURE() << device << " is not listed";
    return {};
  }
};

TEST_F(Doctor, HoldsAndKeepsWhatItMeasured) {
  const std::string device = default_device();
  EXPECT_TRUE(listed(device)["held"].is_null());
  const Result first = doctor({"--device", device, "--json", "-"});
  ASSERT_EQ(first.status, 0) << first.err << first.out;
  const nlohmann::json found = first.json()["devices"][0];
  EXPECT_EQ(found["held"], true);
  EXPECT_GE(found["tests"].size(), 13u);
  for (const nlohmann::json& test : found["tests"]) EXPECT_EQ(test["held"], true) << test;
  EXPECT_FALSE(found["timed"].empty());
  EXPECT_GT(found["cold_ms"], 0);
  EXPECT_GT(found["warm_ms"], 0);
  EXPECT_EQ(listed(device)["held"], true);
  EXPECT_EQ(listed(device)["lanes"], found["lanes"]);

  const Result second = doctor({"--device", device, "--json", "-"});
  ASSERT_EQ(second.status, 0) << second.err;
  const nlohmann::json again = second.json()["devices"][0];
  EXPECT_TRUE(again["timed"].empty()) << "it was measured before";
  EXPECT_EQ(again["cold_ms"], found["cold_ms"]);
  EXPECT_EQ(again["lanes"], found["lanes"]);
}

TEST_F(Doctor, FindsAWrongKernel) {
  const std::string device = default_device();
  program = GLOAM_WITH_FAULTS;
  const Result result = doctor({"--device", device, "--json", "-"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("does not compute what it should"), std::string::npos) << result.err;
  std::map<std::string, bool> held;
  const nlohmann::json document = result.json();
  for (const nlohmann::json& test : document["devices"][0]["tests"]) held[test["technique"]] = test["held"];
  EXPECT_EQ(held, (std::map<std::string, bool>{{"faultless", true}, {"shadows-itself", false}, {"by-lanes", false}}));
  EXPECT_EQ(listed(device)["held"], false);
}

/// What was measured decides, unless the user wants it otherwise, or it is damaged.
TEST_F(Doctor, MeasuredLanesAreUsed) {
  const std::string device = default_device();
  program = GLOAM_WITH_FAULTS;  // writes a record within a second
  doctor({"--device", device});
  program = GLOAM_BINARY;
  const std::vector<fs::path> records = kept(path("cache/devices"), ".json");
  ASSERT_EQ(records.size(), 1u);
  const auto lanes = [&](const Arguments& flags) {
    Arguments all = {"run", "normals", loggia, "-o", path("n.exr").string(), "--json", "-"};
    all.insert(all.end(), flags.begin(), flags.end());
    const Result result = gloam(all, environment());
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json()["lanes"].get<int>();
  };
  const int usual = lanes({}), other = usual == 4 ? 8 : 4;
  nlohmann::json record = nlohmann::json::parse(slurp(records[0]));
  record["tuning"] = {{"lanes", other}, {"group", 8}};
  std::ofstream(records[0]) << record;
  EXPECT_EQ(lanes({}), other);
  EXPECT_EQ(lanes({"--no-tuning"}), usual);
  EXPECT_EQ(lanes({"--lanes", "1"}), 1);
  record["tuning"] = {{"lanes", 3}, {"group", -8}};
  std::ofstream(records[0]) << record;
  EXPECT_EQ(lanes({}), usual);
  std::ofstream(records[0]) << "{\"device\": ";
  EXPECT_EQ(lanes({}), usual);
  EXPECT_TRUE(listed(device)["held"].is_null());
}

/// What suits one kernel may be more than a device, or another kernel, takes.
TEST_F(Doctor, GroupsAreNoLargerThanADeviceTakes) {
  const auto run_to = [&](const char* name, const std::map<std::string, std::string>& more) {
    const Result result = gloam({"run", "gtao", loggia, "-o", path(name).string(), "--math", "precise", "--lanes", "1"},
                                environment(more));
    EXPECT_EQ(result.status, 0) << result.err;
    return slurp(path(name));
  };
  EXPECT_TRUE(run_to("usual.exr", {}) == run_to("small.exr", {{"POCL_MAX_WORK_GROUP_SIZE", "4"}}));
}

/// Wherever a device can be chosen, what doctor measured can be left aside.
TEST_F(Doctor, EveryCommandThatComputesTakesNoTuning) {
  for (const char* command : {"run", "auto", "bench", "pick", "stress"}) {
    const std::string help = gloam({command, "--help-all"}).out;
    EXPECT_NE(help.find("--device"), std::string::npos) << command;
    EXPECT_NE(help.find("--no-tuning"), std::string::npos) << command;
  }
  const Result picked = gloam({"pick", loggia, "--budget", "10s", "--techniques", "ssao", "--rays", "32", "--rounds",
                               "1", "--no-tuning", "--json", "-"},
                              environment());
  ASSERT_EQ(picked.status, 0) << picked.err;
  EXPECT_NE(picked.json()["command"].get<std::string>().find(" --no-tuning"), std::string::npos) << picked.out;
}

/// A damaged constant crashes nothing: only the self-tests notice it.
TEST_F(Doctor, WrongBytesInTheDriversKernelsAreNoticedAndReplaced) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers have handlers of their own, and nothing is started again";
#endif
  fs::create_directory(path("kernels"));
  const std::string device = default_device();
  const std::map<std::string, std::string> driver = {{"POCL_CACHE_DIR", path("kernels").string()}};
  const Result cold = doctor({"--device", device, "--json", "-"}, driver);
  ASSERT_EQ(cold.status, 0) << cold.err;
  if (kept(path("kernels"), ".so").empty()) GTEST_SKIP() << "this driver keeps no kernels in POCL_CACHE_DIR";
  const std::string one("\x00\x00\x80\x3f", 4), two("\x00\x00\x00\x40", 4);
  int damaged = 0;
  for (const fs::path& file : kept(path("kernels"), ".so")) damaged += replace_bytes(file, one, two);
  ASSERT_GT(damaged, 0);
  const Result result = doctor({"--device", device, "--json", "-"}, driver);
  EXPECT_EQ(result.status, 0) << result.err;
  const nlohmann::json found = result.json()["devices"][0];
  EXPECT_EQ(found["held"], true);
  EXPECT_NE(found["notes"].dump().find("were damaged"), std::string::npos) << found["notes"];
  const nlohmann::json after = doctor({"--device", device, "--json", "-"}, driver).json()["devices"][0];
  EXPECT_EQ(after["held"], true);
  EXPECT_TRUE(after["notes"].empty()) << after["notes"];
}

TEST_F(Doctor, SaysWhereNothingLasts) {
  const std::string device = default_device();
  program = GLOAM_WITH_FAULTS;
  const Result unwritable = doctor({"--device", device, "--json", "-"}, {{"GLOAM_CACHE_DIR", "/proc/gloam"}});
  EXPECT_NE(unwritable.json()["notes"].dump().find("/proc/gloam cannot be written: what is kept goes to "),
            std::string::npos)
      << unwritable.out;
  const Result homeless =
      doctor({"--device", device, "--json", "-"}, {{"GLOAM_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ""}});
  EXPECT_NE(homeless.json()["notes"].dump().find("HOME is set: what is kept goes to "), std::string::npos)
      << homeless.out;
}

TEST_F(Doctor, RefusesADeviceThatIsNotThere) {
  const Result result = doctor({"--device", "abacus"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1);
  EXPECT_NE(result.err.find("no device matches 'abacus'; there are "), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

/// Rusticl keeps no compiled kernels: gloam does. It has no double precision either.
TEST_F(Doctor, SecondDeviceHasItsKernelsKeptByGloam) {
  const std::map<std::string, std::string> rusticl = {{"RUSTICL_ENABLE", "llvmpipe"}};
  const Arguments run = {"run", "gtao", loggia, "--set", "half_width=5", "--device", "rusticl", "-o"};
  const auto run_to = [&](const char* name) {
    Arguments all = run;
    all.push_back(path(name).string());
    return gloam(all, environment(rusticl));
  };
  const Result cold = run_to("cold.exr");
  if (cold.status == 1 && cold.err.find("no device matches") != std::string::npos) GTEST_SKIP() << "no Rusticl";
  ASSERT_EQ(cold.status, 0) << cold.err;
  const std::vector<fs::path> kernels = kept(path("cache/kernels"), ".kernel");
  ASSERT_EQ(kernels.size(), 3u);  // the estimate, and the wide filter's columns and rows
  const auto written = fs::last_write_time(kernels[0]);
  ASSERT_EQ(run_to("warm.exr").status, 0);
  EXPECT_TRUE(slurp(path("warm.exr")) == slurp(path("cold.exr")));
  EXPECT_EQ(fs::last_write_time(kernels[0]), written);

  const auto damage = [&](const fs::path& file) {
    std::string bytes = slurp(file);
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 0x10);
    std::ofstream(file, std::ios::binary) << bytes;
  };
  damage(kernels[0]);
  const fs::path half_written = path("cache/kernels/.gloam-0123456789abcdef01234567");  // by a process that was killed
  std::ofstream(half_written) << "gloam compiled";
  const Result mended = run_to("mended.exr");
  EXPECT_EQ(mended.status, 0) << mended.err;
  EXPECT_NE(mended.err.find("note: 1 compiled kernel in gloam's cache folder was damaged"), std::string::npos)
      << mended.err;
  EXPECT_TRUE(slurp(path("mended.exr")) == slurp(path("cold.exr")));
  EXPECT_FALSE(fs::exists(half_written));
  EXPECT_EQ(run_to("after.exr").err.find("damaged"), std::string::npos);

  fs::copy_file(kernels[1], kernels[2], fs::copy_options::overwrite_existing);  // whole, but of another kernel
  fs::resize_file(kernels[0], 40);
  const Result result = gloam({"doctor", "--device", "rusticl", "--json", "-"}, environment(rusticl));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.json()["notes"].dump().find("2 of 3 compiled kernels in "), std::string::npos) << result.out;
  EXPECT_NE(result.json()["devices"][0]["lacks"].dump().find("double precision"), std::string::npos);
  EXPECT_EQ(result.json()["devices"][0]["held"], true);
}

}  // namespace
}  // namespace gloam::test::doctor_test
