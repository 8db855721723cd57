// A driver that ends the process: damaged compiled kernels, no linker, no memory. Only PoCL's kernels are in files that can be
// damaged; the build with sanitizers has no handlers of its own for this.
#include <pty.h>

#include <random>

#include "cli/gloam_process.h"

namespace gloam::test::kernel_cache_test {
namespace {

/// Needs PoCL; other drivers keep nothing in POCL_CACHE_DIR.
class KernelCache : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers have handlers of their own";
#endif
    fs::create_directory(path("cache"));
    const Result cold = run("cold.exr");
    ASSERT_EQ(cold.status, 0) << cold.err;
    if (kept(".bc").empty()) GTEST_SKIP() << "this driver keeps no kernels in POCL_CACHE_DIR";
  }
  /// What a run on a terminal says.
  std::string said_on_terminal(const char* output, const fs::path& kernels) const {
    int terminal = -1;
    const std::string out = path(output).string();
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      setenv("POCL_CACHE_DIR", kernels.c_str(), 1);
      setenv("COLUMNS", "1000", 1);
      execl(program, program, "run", "normals", loggia.c_str(), "-o", out.c_str(), nullptr);
      _exit(127);
    }
    std::string said;
    char part[4096];
    for (ssize_t got; (got = read(terminal, part, sizeof part)) > 0;) said.append(part, size_t(got));
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    EXPECT_EQ(status, 0) << said;
    return said;
  }
  std::map<std::string, std::string> environment(std::map<std::string, std::string> more = {}) const {
    more.emplace("POCL_CACHE_DIR", path("cache").string());
    return more;
  }
  Result run(const char* output, const std::map<std::string, std::string>& more = {},
             const Limits& limits = {.seconds = 60}) const {
    return finish(start({"run", "normals", loggia, "-o", path(output)}, environment(more), limits));
  }
  std::vector<fs::path> kept(const std::string& ending) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path("cache")))
      if (entry.path().extension() == ending) files.push_back(entry.path());
    return files;
  }
  void overwrite(const std::string& ending, const std::string& bytes) const {
    for (const fs::path& file : kept(ending)) std::ofstream(file, std::ios::binary) << bytes;
  }
  std::string noise() const {
    std::mt19937 random(7);
    std::string bytes(5000, ' ');
    for (char& byte : bytes) byte = char(random());
    return bytes;
  }
  void expect_mended(const char* what) const {
    const Result first = run("first.exr");
    EXPECT_EQ(first.status, 0) << what << first.err;
    EXPECT_NE(first.err.find("note: the compiled kernels in " + path("cache").string() + " were damaged"),
              std::string::npos)
        << what << first.err;
    const Result second = run("second.exr");
    EXPECT_EQ(second.status, 0) << what << second.err;
    EXPECT_EQ(second.err, "") << what;
    EXPECT_TRUE(slurp(path("second.exr")) == slurp(path("cold.exr"))) << what;
    EXPECT_EQ(files(), (std::vector<std::string>{"cache", "cold.exr", "first.exr", "second.exr"})) << what;
  }
};

/// A person who waits is told once why; programs are not.
TEST_F(KernelCache, AFirstRunOnATerminalSaysThatItCompiles) {
  fs::create_directory(path("none"));
  const std::string first = said_on_terminal("a.exr", path("none")), second = said_on_terminal("b.exr", path("none"));
  EXPECT_NE(first.find("first run on '"), std::string::npos) << first;
  EXPECT_NE(first.find("kernels are compiled, about a second for each"), std::string::npos) << first;
  EXPECT_EQ(second.find("first run"), std::string::npos) << second;
  fs::create_directory(path("other"));
  const Result quiet = run("c.exr", {{"POCL_CACHE_DIR", path("other").string()}});
  EXPECT_EQ(quiet.err.find("first run"), std::string::npos) << quiet.err;
}

TEST_F(KernelCache, DamagedKernelsAreCompiledAnew) {
  for (const fs::path& file : kept(".so")) fs::resize_file(file, 3000);
  expect_mended("cut");
  overwrite(".so", "");
  expect_mended("empty");
  overwrite(".so", noise());
  expect_mended("noise");
}

TEST_F(KernelCache, DamagedProgramsAreCompiledAnew) {
  const auto without_objects = [&] {
    for (const fs::path& file : kept(".so")) fs::remove(file);
  };
  without_objects();
  overwrite(".bc", "");
  expect_mended("empty");
  without_objects();
  overwrite(".bc", noise());
  expect_mended("noise");
}

TEST_F(KernelCache, FoldersThatAreNotTheDriversStay) {
  fs::create_directory(path("cache") / "mine");
  std::ofstream(path("cache") / "mine/notes") << "kept";
  std::ofstream(path("cache") / "notes") << "kept";
  overwrite(".so", "");
  expect_mended("empty");
  EXPECT_EQ(slurp(path("cache") / "mine/notes"), "kept");
  EXPECT_EQ(slurp(path("cache") / "notes"), "kept");
}

TEST_F(KernelCache, NoLinkerIsSaid) {
  fs::remove_all(path("cache"));
  const Result result = run("ao.exr", {{"PATH", "/nonexistent"}});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.err.find("gloam: the OpenCL driver cannot compile kernels"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("no program 'ld' in PATH"), std::string::npos) << result.err;
  fs::remove_all(path("cache"));
  EXPECT_EQ(files(), (std::vector<std::string>{"cold.exr"}));
}

/// The compiler's exception used to pass through the driver, whose locks stayed taken, and the program waited for ever.
TEST_F(KernelCache, TooLittleMemoryToCompileEndsAtOnce) {
  int refused = 0;
  for (const rlim_t megabytes : {600, 640, 680, 720, 760, 800}) {
    fs::remove_all(path("cache"));
    const Result result = run("ao.exr", {}, {.address_space = megabytes << 20, .seconds = 60});
    if (result.status == 0) continue;
    ++refused;
    EXPECT_EQ(result.status, 1) << megabytes << result.err;
    EXPECT_NE(result.err.find("gloam: "), std::string::npos) << megabytes << result.err;
  }
  EXPECT_GT(refused, 0);
  fs::remove_all(path("cache"));
  for (const std::string& file : files()) EXPECT_TRUE(file == "cold.exr" || file == "ao.exr") << file;
}

}  // namespace
}  // namespace gloam::test::kernel_cache_test
