#include "run/driver.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <vector>

#include "gloam/error.h"

extern char** environ;

namespace gloam {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_handlers_of_its_own = true;
#else
constexpr bool has_handlers_of_its_own = false;
#endif

/// Environment of a restarted command: how often, then the signal; and the folder that was not used.
constexpr const char *restarted = "GLOAM_RESTARTED", *left_folder = "GLOAM_LEFT_KERNELS";
constexpr std::array death = {SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE};

std::atomic<int> at_work = 0;

/// Everything that the handler needs: it cannot allocate.
struct Restart {
  char** arguments = nullptr;
  std::vector<std::string> texts;
  std::vector<char*> environment;
  char* mark = nullptr;  ///< position of the signal's two digits
};
Restart& restart() {
  static Restart* const it = new Restart;  // outlives what runs at exit
  return *it;
}

/// The folder in which PoCL keeps its kernels: the first of these that is set.
fs::path kept_kernels() {
  const char* folder = std::getenv("POCL_CACHE_DIR");
  if (folder) return folder;
  if ((folder = std::getenv("XDG_CACHE_HOME"))) return fs::path(folder) / "pocl/kcache";
  folder = std::getenv("HOME");
  return fs::path(folder ? folder : "/tmp") / ".cache/pocl/kcache";
}

/// A new folder beside that one, so that kernels can be moved; among the temporary files if that fails.
fs::path folder_for_new_kernels() {
  const fs::path kept = kept_kernels();
  const std::string name = fmt::format(".gloam-kernels-{:08x}{:08x}", std::random_device()(), std::random_device()());
  std::error_code none;
  const fs::path beside = kept.has_filename() ? kept.parent_path() : kept.parent_path().parent_path();
  return (access(beside.c_str(), W_OK) == 0 ? beside : fs::temp_directory_path(none)) / name;
}

/// Safe in a handler: nothing is allocated.
void start_again(int signal) {
  Restart& again = restart();
  if (!again.arguments) return;
  again.mark[0] = char('0' + signal / 10);
  again.mark[1] = char('0' + signal % 10);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execve("/proc/self/exe", again.arguments, again.environment.data());
}

void on_death(int signal) {
  if (at_work.load() > 0) start_again(signal);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// "1 06": once, by signal 6.
struct Before {
  int times = 0, signal = 0;
};
Before before() {
  const char* text = std::getenv(restarted);
  if (!text || std::strlen(text) != 4) return {};
  return {text[0] - '0', std::atoi(text + 2)};
}

void remember(char** arguments, int times) {
  Restart& again = restart();
  const fs::path folder = times == 1 ? folder_for_new_kernels() : kept_kernels();
  const auto is_set_here = [](const std::string& entry) {
    return entry.starts_with(std::string(restarted) + "=") || entry.starts_with("POCL_CACHE_DIR=") ||
           entry.starts_with(std::string(left_folder) + "=");
  };
  for (char** entry = environ; *entry; ++entry) {
    if (!is_set_here(*entry)) again.texts.push_back(*entry);
  }
  const char* left = std::getenv(left_folder);
  again.texts.push_back(fmt::format("{}={}", left_folder, times > 1 && left ? left : kept_kernels().string()));
  again.texts.push_back("POCL_CACHE_DIR=" + folder.string());
  again.texts.push_back(fmt::format("{}={} 00", restarted, times));
  for (std::string& text : again.texts) again.environment.push_back(text.data());
  again.environment.push_back(nullptr);
  again.mark = again.texts.back().data() + again.texts.back().size() - 2;
  again.arguments = arguments;
}

bool is_in_path(const char* program) {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "/usr/bin:/bin";
  for (size_t at = 0; at <= folders.size();) {
    const size_t end = std::min(folders.find(':', at), folders.size());
    if (access((fs::path(folders.substr(at, end - at)) / program).c_str(), X_OK) == 0) return true;
    at = end + 1;
  }
  return false;
}

/// A likely cause, and what to do.
std::string likely_cause(const std::string& folder) {
  if (!is_in_path("ld")) return "no program 'ld' in PATH, which PoCL links kernels with; install binutils or set PATH";
  if (const std::string limit = memory_limit(); !limit.empty()) return "memory may have run out" + limit;
  std::error_code failed;
  const fs::space_info space = fs::space(fs::path(folder).parent_path(), failed);
  if (!failed && space.available < (64u << 20))
    return fmt::format("{} has {} MB left; free some, or set POCL_CACHE_DIR to a folder elsewhere", folder,
                       space.available >> 20);
  return fmt::format(
      "and did so with an empty folder in place of {} as well; try another device (gloam list devices) or another "
      "version of the "
      "driver",
      folder);
}

/// The folder of this process's own kernels if it was restarted; else null.
const char* made_anew() {
  const char* folder = std::getenv("POCL_CACHE_DIR");
  const bool is_ours = folder && fs::path(folder).filename().string().starts_with(".gloam-kernels-");
  return before().times > 0 && is_ours ? folder : nullptr;
}

/// Whether an entry is PoCL's own: folders of two letters, and unfinished kernels.
bool is_of_pocl(const fs::path& entry) {
  const std::string name = entry.filename().string();
  const bool two_letters =
      name.size() == 2 && std::all_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'P'; });
  return two_letters || name.starts_with("tempfile_");
}

}  // namespace

bool pocl_keeps_nothing() {
  std::error_code failed;
  for (fs::directory_iterator at(kept_kernels(), failed), end; !failed && at != end; at.increment(failed))
    if (is_of_pocl(at->path()) && at->is_directory(failed)) return false;
  return true;
}

DriverAtWork::DriverAtWork() { ++at_work; }
DriverAtWork::~DriverAtWork() { --at_work; }

void restart_where_the_driver_dies(char** arguments) {
  if (has_handlers_of_its_own) return;
  const Before now = before();
  if (now.times >= 2) {
    const char* left = std::getenv(left_folder);
    const char* how = now.signal ? strsignal(now.signal) : "an exception";
    throw Error("the OpenCL driver cannot compile kernels and ended the program ({}): {}", how,
                likely_cause(left ? left : ""));
  }
  remember(arguments, now.times + 1);
  struct sigaction action {};
  action.sa_handler = on_death;
  action.sa_flags = SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : death) ::sigaction(signal, &action, nullptr);
}

void before_abort() {
  if (at_work.load() > 0) start_again(SIGABRT);
}

std::string keep_kernels_made_anew() {
  const char *left = std::getenv(left_folder), *made = made_anew();
  std::error_code failed;
  if (!left || !made || !fs::exists(made, failed)) return "";
  for (const auto& entry : fs::directory_iterator(left, failed)) {
    if (is_of_pocl(entry.path())) fs::remove_all(entry.path(), failed);
  }
  failed.clear();
  for (const auto& entry : fs::directory_iterator(made))
    fs::rename(entry.path(), fs::path(left) / entry.path().filename(), failed);
  return fmt::format("the compiled kernels in {} were damaged: {}; they were {}", left,
                     before().signal ? "the OpenCL driver ended the program" : "the OpenCL driver could not use them",
                     failed ? "not used, and cannot be replaced; delete that folder" : "compiled anew");
}

void remove_kernels_made_anew() {
  std::error_code ignored;
  if (const char* made = made_anew()) fs::remove_all(made, ignored);
}

std::string memory_limit() {
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "";
  return fmt::format(", at a limit of {} MB (ulimit -v); raise it", limit.rlim_cur >> 20);
}

void restart_without_kept_kernels() {
  if (before().times == 0) start_again(0);
}

}  // namespace gloam
