#include "cli/process/same_mathematics.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

namespace gloam::cli {
namespace {

constexpr const char* variable = "GLIBC_TUNABLES";
constexpr const char* tunable = "glibc.cpu.hwcaps=";
// Names of glibc 2.33 and newer, and of older ones; each ignores the other's.
constexpr const char* without = "-FMA,-FMA4,-FMA_Usable,-FMA4_Usable";

/// The user's own settings with this one.
std::string with_setting(std::string settings) {
  const size_t at = settings.find(tunable);
  if (at == std::string::npos) return settings + (settings.empty() ? "" : ":") + tunable + without;
  return settings.insert(at + std::strlen(tunable), std::string(without) + ",");
}

}  // namespace

void restart_with_same_mathematics(int argc, char** argv) {
  if (argc < 3 || std::strcmp(argv[1], "set") != 0 || std::strcmp(argv[2], "make") != 0) return;
  const char* set = std::getenv(variable);
  const std::string settings = set ? set : "";
  if (settings.find(without) != std::string::npos) return;
  setenv(variable, with_setting(settings).c_str(), 1);
  execv("/proc/self/exe", argv);  // returns only if it fails: then hashes show whether it mattered
}

}  // namespace gloam::cli
