#include "run/kept_folders.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/lists.h"
#include "gloam/device.h"
#include "gloam/error.h"
#include "run/own_folder.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Whether files can be kept in this folder, which is made if it is missing.
bool usable(const fs::path& folder) {
  if (!make_own_folder(folder)) return false;
  std::string probe = (folder / ".gloam-XXXXXX").string();  // root may write anywhere, by the permissions
  return mkdtemp(probe.data()) && rmdir(probe.c_str()) == 0;
}

// --- A folder of this user among the temporary files

/// A folder for this process alone, which removes it at its end.
fs::path folder_of_process(const fs::path& base) {
  std::string pattern = (base / "gloam-kernels-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw Error(
        "no folder to keep compiled kernels in: {}: {}; set POCL_CACHE_DIR or HOME to a folder that can be written",
        base.string(), std::strerror(errno));
  static const fs::path folder = pattern;
  static const pid_t process = getpid();
  std::atexit([] {
    std::error_code ignored;
    if (getpid() == process) fs::remove_all(folder, ignored);
  });
  return folder;
}

fs::path find_own_temporary_folder() {
  std::vector<fs::path> bases;
  std::error_code unset;  // TMPDIR may name a missing folder
  if (const fs::path base = fs::temp_directory_path(unset); !unset) bases.push_back(base);
  bases.emplace_back("/tmp");
  const std::string name = fmt::format("gloam-kernels-{}", geteuid());
  for (const fs::path& base : bases) {
    const fs::path folder = base / name;
    if (why_not_ours(folder).empty() && usable(folder) && why_not_ours(folder).empty()) return folder;
  }
  for (const fs::path& base : bases) {
    if (why_not_ours(base / (name + "-new")).empty() && usable(base)) return folder_of_process(base);
  }
  return folder_of_process("/tmp");
}

/// A folder into which nobody else can have put kernels.
const fs::path& own_temporary_folder() {
  static const fs::path folder = find_own_temporary_folder();
  return folder;
}

// --- Folders that the environment names

/// A variable of the environment that is set and not empty; else null.
const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

/// Where a driver keeps compiled kernels: in the folder of its own variable, else below XDG_CACHE_HOME, else below HOME.
struct DriverCache {
  const char *own, *below_xdg, *below_home;  ///< below_xdg null: the driver does not ask that variable
  bool is_needed;                            ///< without a folder that can be written the driver does not work
  const char* below_temporary;               ///< in place of these
};
constexpr DriverCache driver_caches[] = {
    {"POCL_CACHE_DIR", "pocl/kcache", ".cache/pocl/kcache", true, ""},
    {"MESA_SHADER_CACHE_DIR", "mesa_shader_cache", ".cache/mesa_shader_cache", false, "mesa"},
    {"CUDA_CACHE_PATH", nullptr, ".nv/ComputeCache", false, "cuda"}};

/// Empty: nowhere.
fs::path folder_of(const DriverCache& cache) {
  if (const char* own = variable(cache.own)) return own;
  if (const char* xdg = variable("XDG_CACHE_HOME"); xdg && cache.below_xdg) return fs::path(xdg) / cache.below_xdg;
  if (const char* home = variable("HOME")) return fs::path(home) / cache.below_home;
  return {};
}

/// Why others could put code where it would be run, for each folder that is not used therefore.
std::vector<std::string>& foreign_folders() {
  static std::vector<std::string> all;
  return all;
}

/// The folder that the environment asks for; empty: none.
fs::path asked_for() {
  if (const char* own = variable("GLOAM_CACHE_DIR")) return own;
  if (const char* cache = variable("XDG_CACHE_HOME")) return fs::path(cache) / "gloam";
  if (const char* home = variable("HOME")) return fs::path(home) / ".cache/gloam";
  return {};
}

/// Why a folder is not used; empty: it is.
std::string why_not_used(const fs::path& asked) {
  if (asked.empty()) return "neither GLOAM_CACHE_DIR, XDG_CACHE_HOME nor HOME is set";
  if (std::string why = why_not_ours_once_made(asked); !why.empty()) return why;
  return usable(asked) ? why_not_ours(asked) : fmt::format("{} cannot be written", asked.string());
}

CacheFolder find_cache_folder() {
  const fs::path asked = asked_for();
  const std::string why = why_not_used(asked);
  if (why.empty()) return {asked, ""};
  try {
    const fs::path folder = own_temporary_folder() / "gloam";
    if (usable(folder)) return {folder, why};
  } catch (const Error&) {  // kernels are compiled anew by each process then
  }
  return {{}, why};
}

}  // namespace

const CacheFolder& cache_folder() {
  static const CacheFolder folder = find_cache_folder();
  return folder;
}

std::optional<std::string> kept_text(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return {};
  struct stat about {};
  const bool is_kept = ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode) && about.st_uid == geteuid();
  std::string text(is_kept ? size_t(about.st_size) : 0, '\0');
  size_t have = 0;
  for (ssize_t got = 1; got > 0 && have < text.size(); have += size_t(std::max<ssize_t>(got, 0)))
    got = ::read(descriptor, text.data() + have, text.size() - have);
  ::close(descriptor);
  if (!is_kept) return {};
  text.resize(have);
  return text;
}

void make_way(const fs::path& file) {
  std::error_code ignored;
  if (const fs::file_status status = fs::symlink_status(file, ignored);
      fs::exists(status) && !fs::is_regular_file(status))
    fs::remove(file, ignored);
}

void give_pocl_a_folder() {
  // PoCL uses the first of these that is set; it aborts if that one is empty.
  for (const char* name : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"}) {
    if (std::getenv(name) && !variable(name)) unsetenv(name);
  }
  for (const DriverCache& cache : driver_caches) {
    const fs::path folder = folder_of(cache);
    const std::string why = folder.empty() ? "" : why_not_ours_once_made(folder);
    if (!why.empty()) add_new(foreign_folders(), why);
    const bool can_stay = why.empty() && (!cache.is_needed || (!folder.empty() && usable(folder)));
    if (can_stay) continue;
    const fs::path own = own_temporary_folder();
    setenv(cache.own, (*cache.below_temporary ? own / cache.below_temporary : own).c_str(), 1);
  }
}

namespace {

constexpr std::string_view unfinished = "tempfile_";

std::vector<std::string> unfinished_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (std::string name = entry->path().filename().string(); name.starts_with(unfinished)) names.push_back(name);
  }
  return names;
}

}  // namespace

PoclLeftovers::PoclLeftovers() : before_(unfinished_in(folder_of(driver_caches[0]))) {}

PoclLeftovers::~PoclLeftovers() {
  constexpr auto killed_after = std::chrono::hours(24);
  const fs::path folder = folder_of(driver_caches[0]);
  for (const std::string& name : unfinished_in(folder)) {
    std::error_code failed;
    const fs::path file = folder / name;
    const bool is_probe = name.find('.') == std::string::npos && fs::is_regular_file(file, failed) &&
                          fs::file_size(file, failed) == 0 && !contains(before_, name);
    const auto written = fs::last_write_time(file, failed);
    if (!failed && (is_probe || fs::file_time_type::clock::now() - written > killed_after)) fs::remove(file, failed);
  }
}

std::string foreign_folders_note() {
  std::vector<std::string> why = foreign_folders();
  const CacheFolder& own = cache_folder();
  if (!asked_for().empty() && !own.why_elsewhere.empty() && why_not_ours(asked_for()) == own.why_elsewhere)
    add_new(why, own.why_elsewhere);
  if (why.empty()) return "";
  return fmt::format(
      "{}: somebody else could put code there that would be run; compiled kernels are kept in {} instead",
      enumerate(why), own_temporary_folder().string());
}

}  // namespace gloam
