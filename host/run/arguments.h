// Arguments of a kernel, in the order that Pass states.
#pragma once

#include <string>
#include <vector>

#include "gloam/run.h"
#include "run/view_on_device.h"

namespace gloam {

/// Names of the arguments that a pass declares, in order.
std::vector<std::string> declared_arguments(const PlannedPass& planned, const Layouts& layouts);

/// Sets all arguments of a kernel that runs on `view`, which keeps the buffers that only this pass reads.
void set_arguments(cl::Kernel& kernel, const Plan& plan, const PlannedPass& planned, Device::Impl& device,
                   ViewOnDevice& view, const OtherViews& others, const RunOptions& options);

}  // namespace gloam
