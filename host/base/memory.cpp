#include "base/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Bytes = unsigned long long;

constexpr Bytes unlimited = std::numeric_limits<Bytes>::max();

/// The number in a file; none if the file is missing or holds a word ("max").
std::optional<Bytes> number_in(const fs::path& file) {
  std::ifstream stream(file);
  Bytes value = 0;
  return stream >> value ? std::optional(value) : std::nullopt;
}

/// The number after a name in a file of lines "name number"; none if there is no such line.
std::optional<Bytes> number_named(const fs::path& file, const std::string& name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string word;
    Bytes value = 0;
    if (words >> word >> value && word == name) return value;
  }
  return {};
}

/// Files of the two versions of control groups.
struct Files {
  const char *folder, *limit, *usage, *inactive, *active;
};
constexpr Files second = {"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file", "active_file"};
constexpr Files first = {"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                         "total_inactive_file", "total_active_file"};

Bytes left_in_group(const fs::path& folder, const Files& files) {
  const std::optional<Bytes> limit = number_in(folder / files.limit), used = number_in(folder / files.usage);
  if (!limit || !used) return unlimited;
  const Bytes of_files = number_named(folder / "memory.stat", files.inactive).value_or(0) +
                         number_named(folder / "memory.stat", files.active).value_or(0);
  const Bytes held = *used - std::min(of_files, *used);
  return *limit - std::min(held, *limit);
}

/// Memory left in a group and in all groups around it. In a container the path may be the host's: then the root of the groups is
/// used.
Bytes left_in_groups(const fs::path& root, const Files& files, std::string group) {
  Bytes left = unlimited;
  for (;;) {
    left = std::min(left, left_in_group(root / files.folder / fs::path(group).relative_path(), files));
    if (group.empty() || group == "/") return left;
    group = fs::path(group).parent_path().string();
  }
}

Bytes left_in_control_groups(const fs::path& root) {
  Bytes left = unlimited;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const size_t controllers = line.find(':'), group = line.find(':', controllers + 1);
    if (controllers == std::string::npos || group == std::string::npos) continue;
    const std::string names = "," + line.substr(controllers + 1, group - controllers - 1) + ",",
                      path = line.substr(group + 1);
    if (names == ",,") left = std::min(left, left_in_groups(root, second, path));
    if (names.find(",memory,") != std::string::npos) left = std::min(left, left_in_groups(root, first, path));
  }
  return left;
}

}  // namespace

unsigned long long available_memory(const fs::path& root) {
  const std::optional<Bytes> kibibytes = number_named(root / "proc/meminfo", "MemAvailable:");
  return std::min(kibibytes ? *kibibytes << 10 : unlimited, left_in_control_groups(root));
}

std::string memory_in_words(unsigned long long bytes) {
  constexpr Bytes gibibyte = 1ull << 30, mebibyte = 1ull << 20;
  if (bytes >= gibibyte) return fmt::format("{:.1f} GiB", double(bytes) / double(gibibyte));
  return fmt::format("{} MiB", (bytes + mebibyte - 1) / mebibyte);
}

}  // namespace gloam
