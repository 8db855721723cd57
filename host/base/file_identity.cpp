#include "base/file_identity.h"

#include <sys/stat.h>

namespace gloam {
namespace {

namespace fs = std::filesystem;

std::optional<std::pair<dev_t, ino_t>> inode_of(const fs::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return {};
  return std::pair(about.st_dev, about.st_ino);
}

}  // namespace

fs::path follow_links(const fs::path& path) {
  constexpr int most_links = 40;  // Linux follows as many
  fs::path target = path;
  std::error_code code;
  for (int i = 0; i < most_links && fs::is_symlink(target, code); ++i) {
    const fs::path next = fs::read_symlink(target, code);
    if (code) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

FileIdentity identity_of(const fs::path& path) {
  const fs::path target = follow_links(path);
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(target, unknown), unknown);
  return {(unknown ? target.lexically_normal() : whole).string(), inode_of(target)};
}

bool are_same_file(const fs::path& a, const fs::path& b) {
  const FileIdentity first = identity_of(a), second = identity_of(b);
  return first.place == second.place || (first.file && first.file == second.file);
}

}  // namespace gloam
