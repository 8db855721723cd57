// Memory that frames take, calculated from headers, and how many of a shot are worked on at once.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame_files.h"
#include "gloam/plan.h"
#include "sequence/pipeline.h"

namespace gloam {

/// Memory of a process for code and libraries: without a device, and with a device that has compiled kernels.
inline constexpr unsigned long long process_bytes = 48ull << 20, process_bytes_with_device = 160ull << 20;

/// Peak memory for reading planes of a frame of one file or two, and of its history.
unsigned long long bytes_to_read(const FrameFiles& files, const std::vector<std::string>& planes);

/// Peak memory of a process that runs a plan, for a frame that is read with these planes.
unsigned long long bytes_of_run(const FrameFiles& files, const std::vector<std::string>& planes, const Plan& plan,
                                bool shares_memory);

/// How much memory a process may take, and why: "--limit-memory 4G allows 4.0 GiB".
struct MemoryLimit {
  unsigned long long bytes = 0;
  std::string words;
};
/// What is available.
MemoryLimit available_limit();

/// The largest pipeline within a limit.
struct ShotMemory {
  PipelineSize size;
  unsigned long long frame = 0, all = 0;  ///< most that a frame in flight may take; the whole process. 0: not counted
};

/// `own`: bytes of a frame in flight; `beside`: of the process without these. Throws Error if one frame does not fit; `ways_out`:
/// advice for less, in words.
ShotMemory shot_memory(const std::string& name, unsigned long long own, unsigned long long beside,
                       const MemoryLimit& limit, const std::string& ways_out);

}  // namespace gloam
