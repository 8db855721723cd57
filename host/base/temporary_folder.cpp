#include "base/temporary_folder.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "base/files.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr size_t random_letters = 6;

// --- At a signal: system calls alone, since nothing else is safe in a handler

/// An entry of a folder as the kernel gives it.
struct Recorded {
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
  alignas(Recorded) char bytes[2048];
  long got = 0;
  while ((got = ::syscall(SYS_getdents64, folder, bytes, sizeof bytes)) > 0) {
    for (long at = 0; at < got;) {
      const Recorded* entry = reinterpret_cast<const Recorded*>(bytes + at);
      const bool is_itself = std::strcmp(entry->name, ".") == 0 || std::strcmp(entry->name, "..") == 0;
      if (!is_itself) remove_tree(folder, entry->name, levels - 1);
      at += entry->length;
    }
  }
  ::close(folder);
  ::unlinkat(above, name, AT_REMOVEDIR);
}

/// A folder that exists, where a handler can read its name.
struct Known {
  std::atomic<bool> is_taken{false}, exists{false};
  char path[PATH_MAX];
};
std::array<Known, 8> all_known;

void remove_known() {
  constexpr int levels = 12;  // kernels of PoCL lie in the fifth
  for (const Known& known : all_known)
    if (known.exists.load()) remove_tree(AT_FDCWD, known.path, levels);
}

void remember(const std::string& path) {
  if (path.size() >= PATH_MAX) return;
  for (Known& known : all_known) {
    if (known.is_taken.exchange(true)) continue;
    std::memcpy(known.path, path.c_str(), path.size() + 1);
    known.exists.store(true);
    return call_on_signal(&remove_known);
  }
}

void forget(const std::string& path) {
  for (Known& known : all_known) {
    if (!known.exists.load() || path != known.path) continue;
    known.exists.store(false);
    known.is_taken.store(false);
  }
}

// --- Folders of killed processes

enum class Lock { taken, of_another, none };  ///< none: the file system has no locks

/// Opens and locks a folder; `descriptor` is -1 where another process has the lock, or the folder is gone.
Lock lock_folder(const fs::path& folder, int& descriptor) {
  descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return errno == ENOENT ? Lock::of_another : Lock::none;
  struct stat about {};
  const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (!is_locked && errno != EWOULDBLOCK) return Lock::none;
  // A folder without links was removed by a process that had the lock before.
  if (is_locked && ::fstat(descriptor, &about) == 0 && about.st_nlink > 0) return Lock::taken;
  ::close(descriptor);
  descriptor = -1;
  return Lock::of_another;
}

bool is_of_this_user(int descriptor) {
  struct stat about {};
  return ::fstat(descriptor, &about) == 0 && about.st_uid == ::geteuid();
}

void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code failed, ignored;
  for (fs::directory_iterator entry(parent, failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.size() != prefix.size() + random_letters || !name.starts_with(prefix)) continue;
    int descriptor = -1;  // its process had it locked to its end
    if (lock_folder(entry->path(), descriptor) == Lock::taken && is_of_this_user(descriptor))
      fs::remove_all(entry->path(), ignored);
    if (descriptor >= 0) ::close(descriptor);
  }
}

fs::path folder_of_temporaries() {
  std::error_code unset;
  const fs::path base = fs::temp_directory_path(unset);
  if (unset) throw Error("no folder for temporary files: TMPDIR names none ({})", unset.message());
  return base;
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& kind)
    : TemporaryFolder(folder_of_temporaries(), "gloam-" + kind + "-") {}

TemporaryFolder::TemporaryFolder(const fs::path& parent, const std::string& prefix) {
  remove_abandoned(parent, prefix);
  // Another process may take one for a leftover before it is locked, and remove it.
  do {
    std::string path = (parent / (prefix + std::string(random_letters, 'X'))).string();
    if (!::mkdtemp(path.data()))
      throw Error("{}: no folder can be made in it ({})", parent.string(), std::strerror(errno));
    path_ = path;
  } while (lock_folder(path_, lock_) == Lock::of_another);
  remember(path_.string());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  forget(path_.string());
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace gloam
