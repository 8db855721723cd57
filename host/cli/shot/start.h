// What happens once before the first frame of a shot is written.
#pragma once

#include <list>
#include <vector>

#include "cli/shot/shot.h"
#include "sequence/frame_locks.h"

namespace gloam::cli {

/// Locks the frames of all outputs, removes what killed processes left, and says what an interruption leaves.
class ShotStart {
 public:
  ShotStart(const NamedPatterns& outputs, const std::vector<int>& frames);

 private:
  std::list<FrameLocks> locks_;
};

}  // namespace gloam::cli
