#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/elapsed.h"
#include "gloam/error.h"

namespace gloam {
namespace {

enum class Attempt { locked, held, no_locks };

/// A write lock on bytes of an open file; `length` 0: to its end. It belongs to the descriptor, not to the process, and ends
/// when that is closed.
Attempt lock_bytes(int descriptor, off_t first, off_t length) {
  struct flock region {};
  region.l_type = F_WRLCK;
  region.l_whence = SEEK_SET;
  region.l_start = first;
  region.l_len = length;
  int failed = 0;
  do failed = ::fcntl(descriptor, F_OFD_SETLK, &region) == 0 ? 0 : errno;
  while (failed == EINTR);
  if (failed == 0) return Attempt::locked;
  // A server of files that is busy (ENOLCK) may grant the lock later.
  return failed == EAGAIN || failed == EACCES || failed == ENOLCK ? Attempt::held : Attempt::no_locks;
}

Attempt lock_all(int descriptor, const FileLock::Ranges& bytes) {
  for (const auto& [first, last] : bytes) {
    const Attempt attempt = lock_bytes(descriptor, first, off_t(last - first) + 1);
    if (attempt != Attempt::locked) return attempt;
  }
  return Attempt::locked;
}

/// Whether the file still has a name: the last process to end removes it.
bool has_name(int descriptor) {
  struct stat about {};
  return ::fstat(descriptor, &about) == 0 && about.st_nlink > 0;
}

/// Whoever may write into the folder may lock files in it, whatever the mask of the user who came first.
void share_as_folder(int descriptor, const std::filesystem::path& file) {
  struct stat folder {};
  const std::filesystem::path above = file.parent_path();
  if (::stat(above.empty() ? "." : above.c_str(), &folder) == 0) (void)!::fchmod(descriptor, folder.st_mode & 0666);
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file, const Ranges& bytes, double patience) : path_(file.string()) {
  constexpr auto pause = std::chrono::milliseconds(2);
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0) throw Error("{}: cannot be made ({})", path_, std::strerror(errno));
    share_as_folder(descriptor_, file);
    const Attempt attempt = lock_all(descriptor_, bytes);
    if (attempt == Attempt::no_locks || (attempt == Attempt::locked && has_name(descriptor_))) return;
    ::close(descriptor_);
    descriptor_ = -1;
    if (attempt == Attempt::locked) continue;  // whoever held it has removed the file
    if (seconds_since(start) >= patience) return;
    std::this_thread::sleep_for(pause);
  }
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  // Nobody else holds a lock, and who comes now finds the file without a name, and makes another.
  if (lock_bytes(descriptor_, 0, 0) == Attempt::locked && has_name(descriptor_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace gloam
