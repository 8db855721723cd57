// How many frames of a shot are worked on at once.
#pragma once

#include <string>

#include "cli/flags/memory.h"
#include "sequence/pipeline.h"

namespace gloam::cli {

/// The largest pipeline within the limit.
struct ShotMemory {
  PipelineSize size;
  unsigned long long frame, all;  ///< most that a frame in flight may take; the whole process
};

/// `own`: bytes of a frame in flight; `beside`: of the process without these. Throws Error if one frame does not fit; `ways_out`:
/// advice for less, in words.
ShotMemory shot_memory(const std::string& name, unsigned long long own, unsigned long long beside,
                       const MemoryLimit& limit, const std::string& ways_out);

}  // namespace gloam::cli
