#include "sequence/frame_locks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/hash.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {
namespace {

/// A write lock on bytes of an open file; `length` 0: to its end. It belongs to the descriptor, not to the process, and ends
/// when that is closed.
bool lock_bytes(int descriptor, off_t first, off_t length) {
  struct flock region {};
  region.l_type = F_WRLCK;
  region.l_whence = SEEK_SET;
  region.l_start = first;
  region.l_len = length;
  return ::fcntl(descriptor, F_OFD_SETLK, &region) == 0;
}

bool is_held_by_another(int error) { return error == EAGAIN || error == EACCES; }

/// Whether the file still has a name: the last process to end removes it.
bool has_name(int descriptor) {
  struct stat about {};
  return ::fstat(descriptor, &about) == 0 && about.st_nlink > 0;
}

}  // namespace

FrameLocks::FrameLocks(const FramePattern& output, const std::vector<int>& frames) {
  // The name's hash, since the pattern's own name may be as long as names can be.
  path_ = (output.folder() / fmt::format(".gloam-lock-{:016x}", hash_of(output.normal_name()))).string();
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw Error("{}: cannot be written: {}", output.text(), std::strerror(errno));
    for (const auto& [first, last] : ranges_of(frames)) {
      if (lock_bytes(descriptor_, first, off_t(last - first) + 1)) continue;
      if (!is_held_by_another(errno)) return;
      ::close(descriptor_);
      throw Error(
          "{}: another gloam is writing frames among {}-{}; wait for its end, or name other frames or another output",
          output.text(), frames.front(), frames.back());
    }
    if (has_name(descriptor_)) return;
    ::close(descriptor_);
  }
  throw Error("{}: cannot be locked: processes come and go too fast; try again", output.text());
}

FrameLocks::~FrameLocks() {
  // Nobody else holds a lock, and who comes now finds the file without a name, and makes another.
  if (lock_bytes(descriptor_, 0, 0) && has_name(descriptor_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace gloam
