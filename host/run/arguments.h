// What a kernel is called with, in the order that Pass promises.
#pragma once

#include <string>
#include <vector>

#include "gloam/run.h"
#include "run/view_on_device.h"

namespace gloam {

/// Names of the arguments that a pass declares, in order.
std::vector<std::string> declared_arguments(const PlannedPass& planned, const Layouts& layouts);

/// Sets all of them on a kernel that runs on `view`, which keeps the buffers that the pass alone reads.
void set_arguments(cl::Kernel& kernel, const Plan& plan, const PlannedPass& planned, Device::Impl& device,
                   ViewOnDevice& view, const OtherViews& others, const RunOptions& options);

}  // namespace gloam
