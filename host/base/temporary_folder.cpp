#include "base/temporary_folder.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>

#include "base/files.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr size_t random_letters = 6;

// --- At a signal: system calls alone, since nothing else is safe in a handler

/// An entry of a folder as the kernel gives it.
struct Entry {
  uint64_t inode;
  int64_t offset;
  unsigned short length;
  unsigned char type;
  char name[1];
};

void remove_tree(int above, const char* name, int levels) {
  if (::unlinkat(above, name, 0) == 0 || levels == 0) return;
  const int folder = ::openat(above, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  alignas(Entry) char bytes[2048];
  long got = 0;
  while ((got = ::syscall(SYS_getdents64, folder, bytes, sizeof bytes)) > 0) {
    for (long at = 0; at < got;) {
      const Entry* entry = reinterpret_cast<const Entry*>(bytes + at);
      const bool is_itself = std::strcmp(entry->name, ".") == 0 || std::strcmp(entry->name, "..") == 0;
      if (!is_itself) remove_tree(folder, entry->name, levels - 1);
      at += entry->length;
    }
  }
  ::close(folder);
  ::unlinkat(above, name, AT_REMOVEDIR);
}

/// The folder that exists, where a handler can read its name; a process has one at a time.
struct Known {
  std::atomic<bool> exists{false};
  char path[PATH_MAX];
};
Known known;

void remove_known() {
  constexpr int levels = 12;  // kernels of PoCL lie in the fifth
  if (known.exists.load()) remove_tree(AT_FDCWD, known.path, levels);
}

// --- Folders of killed processes

/// Whether no process has it: its lock ended with the process. A new one is locked at once.
bool is_abandoned(const fs::path& folder) {
  constexpr time_t new_for = 60;  ///< seconds
  struct stat about {};
  if (::lstat(folder.c_str(), &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != ::geteuid()) return false;
  if (about.st_mtime > std::time(nullptr) - new_for) return false;
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  ::close(descriptor);
  return is_free;
}

void remove_abandoned(const fs::path& base, const std::string& prefix) {
  std::error_code failed, ignored;
  for (fs::directory_iterator entry(base, failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.size() == prefix.size() + random_letters && name.starts_with(prefix) && is_abandoned(entry->path()))
      fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& kind) {
  std::error_code unset;
  const fs::path base = fs::temp_directory_path(unset);
  if (unset) throw Error("no folder for temporary files: TMPDIR names none ({})", unset.message());
  const std::string prefix = "gloam-" + kind + "-";
  remove_abandoned(base, prefix);
  std::string pattern = (base / (prefix + std::string(random_letters, 'X'))).string();
  if (!mkdtemp(pattern.data())) throw Error("{}: no folder can be made: {}", pattern, std::strerror(errno));
  path_ = pattern;
  lock_ = ::open(pattern.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
  if (pattern.size() >= sizeof known.path || known.exists.load()) return;
  std::memcpy(known.path, pattern.c_str(), pattern.size() + 1);
  known.exists.store(true);
  call_on_signal(&remove_known);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (path_ == known.path) known.exists.store(false);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace gloam
