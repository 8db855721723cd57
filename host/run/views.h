// Runs a plan's passes on the views of a frame.
#pragma once

#include "gloam/run.h"
#include "run/device_impl.h"

namespace gloam {

/// Pixels that a mask lets an estimate skip, and that a second one sees to, of all that there are.
struct Counted {
  double skipped = 0, rest = 0, of = 0;
};

/// Views are computed together where they look at one another, else one after another. Adds to `result` and `counted`.
void run_all_views(const Plan& plan, const Frame& frame, Device::Impl& device, const RunOptions& options,
                   RunResult& result, Counted& counted);

}  // namespace gloam
