// Runs the gloam binary as a user would, and gives its output, status and files.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gloam/exr.h"

namespace gloam::test {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

struct Result {
  int status = -1;  ///< exit status; 128 + signal when a signal ended it
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
  /// The document without the memory, which changes with the number of files and pictures.
  nlohmann::json findings() const {
    nlohmann::json document = json();
    document.erase("memory_bytes");
    return document;
  }
  long lines_of_error() const { return std::count(err.begin(), err.end(), '\n'); }
};

inline std::string slurp(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Width and height from a PNG's header.
inline std::pair<int, int> png_size(const fs::path& path) {
  const std::string bytes = slurp(path);
  EXPECT_EQ(bytes.substr(0, 4), "\x89PNG");
  const auto number = [&](size_t at) {
    int n = 0;
    for (size_t i = 0; i < 4; ++i) n = n * 256 + static_cast<unsigned char>(bytes.at(at + i));
    return n;
  };
  return {number(16), number(20)};
}

/// Limits on a run: memory beyond is refused, and the run is ended after this many seconds.
struct Limits {
  rlim_t address_space = RLIM_INFINITY;  ///< bytes
  unsigned seconds = 500;                ///< below ctest's own limit, so that the output is still shown
};

/// At most two cores: each thread takes memory for its stack and its allocations, on a machine with many cores most of a gibibyte.
inline void leave_two_cores() {
  cpu_set_t allowed, two;
  CPU_ZERO(&two);
  sched_getaffinity(0, sizeof allowed, &allowed);
  for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&two) < 2; ++core)
    if (CPU_ISSET(core, &allowed)) CPU_SET(core, &two);
  sched_setaffinity(0, sizeof two, &two);
  setenv("POCL_MAX_PTHREAD_COUNT", "2", 1);
}

/// Called in the process to be limited. Sanitizers map terabytes for themselves, and take their time.
inline void limit_this_process(const Limits& limits) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  alarm(500);
#else
  alarm(limits.seconds);
  if (limits.address_space == RLIM_INFINITY) return;
  leave_two_cores();
  const rlimit limit{limits.address_space, limits.address_space};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

/// A folder of its own for each test, removed at its end.
class Cli : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-cli-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path path(const std::string& name) const { return folder / name; }

  /// Starts gloam; `environment` is added to this process's own.
  pid_t start(const Arguments& arguments, const std::map<std::string, std::string>& environment = {},
              const Limits& limits = {}) const {
    const pid_t child = fork();
    if (child != 0) return child;
    signal(SIGINT, SIG_DFL);  // a shell lets its background jobs ignore it, which their children inherit
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    dup2(open(path("stdout").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
    dup2(open(path("stderr").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
    std::vector<char*> argv = {const_cast<char*>(program)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    limit_this_process(limits);
    execv(program, argv.data());
    _exit(127);
  }

  Result finish(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(path("stdout")),
            slurp(path("stderr"))};
  }

  Result gloam(const Arguments& arguments, const std::map<std::string, std::string>& environment = {}) const {
    return finish(start(arguments, environment));
  }
  Result gloam_within(const Limits& limits, const Arguments& arguments) const {
    return finish(start(arguments, {}, limits));
  }

  /// Everything in the folder except the captured output.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name != "stdout" && name != "stderr") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder;
  const char* program = GLOAM_BINARY;
};

inline const fs::path data_folder = fs::path(GLOAM_SOURCE_DIR) / "data";
inline const std::string loggia = (data_folder / "loggia.exr").string();
inline const std::string loggia_truth = (data_folder / "loggia_ao_ref.exr").string();
inline const fs::path captures = GLOAM_CAPTURES;

/// A small frame of a floor before a wall.
inline Frame small_frame(int width = 32, int height = 24, const std::vector<std::string>& planes = {"depth", "color"}) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  View view;
  Camera camera;
  camera.fx = camera.fy = width;
  camera.cx = width / 2.0;
  camera.cy = height / 2.0;
  camera.source = "test";
  view.camera = camera;
  const Layout layout(width, height);
  for (const std::string& name : planes) {
    Plane plane{name, {}};
    const int components = name == "color" || name == "normal" ? 3 : 1;
    for (int i = 0; i < components; ++i) plane.channels.emplace_back(layout, name == "normal" ? float(i == 2) : 0.5f);
    view.planes[name] = std::move(plane);
  }
  if (Plane* depth = view.planes.count("depth") ? &view.planes["depth"] : nullptr) {
    for (int y = 0; y < height; ++y) {
      const double below = (y + 0.5 - camera.cy) / camera.fy;
      for (int x = 0; x < width; ++x) depth->channels[0].at(x, y) = float(below > 0 ? std::min(4.0, 1 / below) : 4.0);
    }
  }
  frame.views.push_back(std::move(view));
  return frame;
}

}  // namespace gloam::test
