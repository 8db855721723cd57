// The kernels of a plan's passes, built for a device.
#pragma once

#include "gloam/run.h"
#include "plan/layouts.h"
#include "run/device_impl.h"

namespace gloam {

/// Lanes and group sizes: as the options state, else what suits the device.
Tuning tuning_for(const DeviceInfo& info, const RunOptions& options);

/// What the compiler is told of a pass's kernel.
std::string build_options(const PlannedPass& planned, const DeviceInfo& info, const RunOptions& options,
                          const Tuning& tuning);

/// The whole text of a pass's kernel, as it is compiled.
std::string kernel_text(const PlannedPass& planned, const Layouts& layouts);

/// Builds a pass's kernel. Throws Error for a missing kernel, and for build errors (with the log).
cl::Kernel build_kernel(const PlannedPass& planned, const Layouts& layouts, Device::Impl& device,
                        const RunOptions& options, const Tuning& tuning);

}  // namespace gloam
