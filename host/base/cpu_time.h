// Time that the cores spent on this process.
#pragma once

#include <ctime>

namespace gloam {

/// Milliseconds of all threads together, since the process began. Where others want the cores too, a computation takes longer by the
/// wall clock, but hardly more of this.
inline double process_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

}  // namespace gloam
