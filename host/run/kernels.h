// The kernels of a plan's passes, built for a device.
#pragma once

#include "gloam/run.h"
#include "run/device_impl.h"
#include "plan/layouts.h"

namespace gloam {

/// Pixels per work-item: as the options say, else what suits the device.
int lanes_for(const DeviceInfo& info, const RunOptions& options);

/// Builds a pass's kernel. Throws Error: no such kernel, a build log, or arguments that are not those that the pass declares.
cl::Kernel build_kernel(const PlannedPass& planned, const Layouts& layouts, Device::Impl& device,
                        const RunOptions& options, int lanes);

}  // namespace gloam
