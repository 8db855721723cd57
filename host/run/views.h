// Runs a plan's passes on the views of a frame.
#pragma once

#include "gloam/run.h"
#include "run/device_impl.h"
#include "run/view_on_device.h"

namespace gloam {

/// Numbers of pixels: skipped by a mask's estimate, computed by a second one, and in all.
struct Counted {
  double skipped = 0, rest = 0, of = 0;
};

/// Computes views together if they read one another, else one after another. Adds to `result` and `counted`.
void run_all_views(const Plan& plan, const Frame& frame, Device::Impl& device, const RunOptions& options,
                   RunResult& result, Counted& counted);

/// Finds which passes run on which of the views that are on the device together, and builds their kernels.
void build_passes(const Plan& plan, std::vector<ViewOnDevice>& targets, Device::Impl& device,
                  const RunOptions& options);

/// Enqueues these passes, and waits for none of them.
void enqueue_passes(const Plan& plan, std::vector<ViewOnDevice>& targets, Device::Impl& device,
                    const RunOptions& options);

}  // namespace gloam
