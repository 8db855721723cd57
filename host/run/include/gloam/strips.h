// Frames that are too large for a device, in strips of rows.
#pragma once

#include <string>

#include "gloam/run.h"

namespace gloam {

/// A frame's division into strips of rows, from the top, each computed with `margin` more rows on either side, as far as there are any.
struct Strips {
  int count = 1;
  int rows = 0;                         ///< of each but the last
  int margin = 0;                       ///< as far as the radius and the filters reach, by the frame's nearest depth
  unsigned long long device_bytes = 0;  ///< of one strip
  std::string why_not;                  ///< why the plan cannot be computed in strips, or in so many; empty if it can
};

/// `count`: of strips; 0: as few as fit into the device's memory.
Strips strips_for(const Plan& plan, const Frame& frame, const DeviceInfo& device, int count = 0);

/// As `run`, strip by strip. The estimate is the same but for the random numbers of its samples, which begin anew in each strip. Throws
/// as `run` does, and Error for a plan that cannot be computed in strips.
RunResult run_in_strips(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options,
                        const Strips& strips);

/// Throws Error as `run` does if the device lacks the memory, and adds in how many strips the plan can be computed on it. `way`: how they
/// are asked for.
void check_memory_or_offer_strips(const Plan& plan, const Frame& frame, const Device& device, const std::string& way);

}  // namespace gloam
