// Runs a plan's passes on the views of a frame.
#pragma once

#include "gloam/run.h"
#include "run/device_impl.h"

namespace gloam {

/// Numbers of pixels: skipped by a mask's estimate, computed by a second one, and in all.
struct Counted {
  double skipped = 0, rest = 0, of = 0;
};

/// Computes views together if they read one another, else one after another. Adds to `result` and `counted`.
void run_all_views(const Plan& plan, const Frame& frame, Device::Impl& device, const RunOptions& options,
                   RunResult& result, Counted& counted);

}  // namespace gloam
