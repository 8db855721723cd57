// Keeps two processes from writing the same frames of a sequence.
#pragma once

#include <vector>

#include "base/file_lock.h"
#include "gloam/frame_pattern.h"

namespace gloam {

/// Locks on frames of an output sequence, from construction to destruction: bytes of a hidden file in the output's folder (`FileLock`),
/// one for each frame. Processes on other frames, also on another machine, go on beside this one.
class FrameLocks {
 public:
  /// Throws Error, in one line, if another process has locked one of the frames (ascending numbers), or if the file cannot be
  /// made. Where the file system has no locks, nothing is locked.
  FrameLocks(const FramePattern& output, const std::vector<int>& frames);

 private:
  FileLock lock_;
};

}  // namespace gloam
