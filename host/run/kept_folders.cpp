#include "run/kept_folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "gloam/device.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Whether files can be kept below this folder, which is made if it is missing.
bool usable(const fs::path& folder) {
  std::error_code unknown;
  fs::create_directories(folder, unknown);
  std::string probe = (folder / ".gloam-XXXXXX").string();  // root may write anywhere, by the permissions
  return mkdtemp(probe.data()) && rmdir(probe.c_str()) == 0;
}

/// A folder into which nobody else can have put kernels.
fs::path own_temporary_folder() {
  std::error_code unset;  // TMPDIR may name a missing folder
  fs::path base = fs::temp_directory_path(unset);
  if (unset || !usable(base)) base = "/tmp";
  const fs::path folder = base / fmt::format("gloam-kernels-{}", getuid());
  mkdir(folder.c_str(), 0700);
  struct stat facts;
  const bool ours = lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == getuid() &&
                    (facts.st_mode & 077) == 0;
  if (ours) return folder;
  std::string pattern = (base / "gloam-kernels-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw Error(
        "no folder to keep compiled kernels in: {}: {}; set POCL_CACHE_DIR or HOME to a folder that can be written",
        base.string(), std::strerror(errno));
  return pattern;
}

/// A variable of the environment that is set and not empty; else null.
const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

/// The folder that the environment asks for; empty: none.
fs::path asked_for() {
  if (const char* own = variable("GLOAM_CACHE_DIR")) return own;
  if (const char* cache = variable("XDG_CACHE_HOME")) return fs::path(cache) / "gloam";
  if (const char* home = variable("HOME")) return fs::path(home) / ".cache/gloam";
  return {};
}

CacheFolder find_cache_folder() {
  const fs::path asked = asked_for();
  if (!asked.empty() && usable(asked)) return {asked, ""};
  const std::string why = asked.empty() ? "neither GLOAM_CACHE_DIR, XDG_CACHE_HOME nor HOME is set"
                                        : fmt::format("{} cannot be written", asked.string());
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

void give_pocl_a_folder() {
  // PoCL uses the first of these that is set; it aborts if that one is empty.
  for (const auto& [name, below] :
       {std::pair("POCL_CACHE_DIR", ""), std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")}) {
    const char* folder = std::getenv(name);
    if (folder && *folder == '\0')
      unsetenv(name);
    else if (folder && usable(fs::path(folder) / below))
      return;
    else if (folder)
      break;
  }
  setenv("POCL_CACHE_DIR", own_temporary_folder().c_str(), 1);
}

}  // namespace gloam
