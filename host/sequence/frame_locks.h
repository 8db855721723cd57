// Keeps two processes from writing the same frames of a sequence.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame_pattern.h"

namespace gloam {

/// Locks on frames of an output sequence, from construction to destruction. They are locks of the operating system on a hidden
/// file in the output's folder, a byte for each frame: they end with the process, however it ends, and processes on other
/// frames, also on another machine, go on beside this one. The last process to end removes the file.
class FrameLocks {
 public:
  /// Throws Error, in one line, if another process has locked one of the frames (ascending numbers), or if the file cannot be
  /// made. Where the file system has no locks, nothing is locked.
  FrameLocks(const FramePattern& output, const std::vector<int>& frames);
  ~FrameLocks();
  FrameLocks(const FrameLocks&) = delete;
  FrameLocks& operator=(const FrameLocks&) = delete;

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace gloam
