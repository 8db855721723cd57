// Arguments of a kernel, in the order that Pass states.
#pragma once

#include <string>
#include <vector>

#include "gloam/run.h"
#include "run/view_on_device.h"

namespace gloam {

/// An argument of a kernel: "PLANE", "normal_x".
struct Argument {
  std::string type, name;
};

/// The arguments that a pass declares, in order.
std::vector<Argument> declared_arguments(const PlannedPass& planned, const Layouts& layouts);

/// What stands before a kernel's text: its parameters as the struct Params, and its arguments as the macro ARGUMENTS.
std::string declaration_of(const PlannedPass& planned, const Layouts& layouts);

/// Sets all arguments of a kernel that runs on `view`, which keeps the buffers that only this pass reads.
void set_arguments(cl::Kernel& kernel, const Plan& plan, const PlannedPass& planned, Device::Impl& device,
                   ViewOnDevice& view, const OtherViews& others, const RunOptions& options);

}  // namespace gloam
