#include "run/kernels.h"

#include <cstdlib>

#include "gloam/error.h"
#include "run/arguments.h"
#include "run/driver.h"
#include "run/launch.h"
#include "run/tuning.h"
#include "technique/kernel_sources.h"

namespace gloam {

Tuning tuning_for(const DeviceInfo& info, const RunOptions& options) {
  Tuning tuning = info.tuning;
  if (options.real == Real::float64 && tuning.lanes > 4) tuning.lanes /= 2;
  if (options.lanes != 0) tuning.lanes = options.lanes;
  if (options.group != 0) tuning.search.group = tuning.others.group = options.group;
  return tuning;
}

std::string build_options(const PlannedPass& planned, const DeviceInfo& info, const RunOptions& options,
                          const Tuning& tuning) {
  std::string text = "-cl-std=CL1.2 " + options_of(tuning);
  if (options.math == Math::fast) text += " -D MATH_FAST=1";
  if (options.math == Math::precise && info.rounds_correctly) text += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (options.real == Real::float64) text += " -D REAL_DOUBLE=1";
  if (info.type == "gpu") text += " -D NATIVE_INVERSE=1";
  // The table of devices has a limit where the driver takes one.
  const int registers = of_kind(tuning, planned.pass).registers;
  if (registers > 0 && info.usual.search.registers > 0) text += fmt::format(" -cl-nv-maxrregcount={}", registers);
  // Tests make quotients inexact, as they are on GPUs (docs/portability.md).
  if (const char* error = std::getenv("GLOAM_QUOTIENT_ERROR"); error && *error)
    text += fmt::format(" -D QUOTIENT_ERROR={}", std::atoi(error));
  if (options.gathers_only) text += " -D GATHERS_ONLY=1";
  if (planned.pass.goes_down) text += fmt::format(" -D ROWS_OF_ITEM={}", rows_of_item(info, planned.pass));
  for (const auto& [name, value] : planned.pass.defines) text += fmt::format(" -D {}={}", name, value);
  return text;
}

std::string kernel_text(const PlannedPass& planned, const Layouts& layouts) {
  return kernel_text(source_of(*planned.technique, planned.pass), planned.pass.kernel,
                     declaration_of(planned, layouts));
}

cl::Kernel build_kernel(const PlannedPass& planned, const Layouts& layouts, Device::Impl& device,
                        const RunOptions& options, const Tuning& tuning) {
  const std::string& source = source_of(*planned.technique, planned.pass);
  cl::Program& program = device.program(source, planned.pass.kernel, declaration_of(planned, layouts),
                                        build_options(planned, device.info, options, tuning));
  try {
    return cl::Kernel(program, planned.pass.kernel.c_str());
  } catch (const cl::Error& error) {
    restart_without_kept_kernels();  // a damaged kept program may have lost them
    throw Error("{}: kernels/{} has no kernel void {}(ARGUMENTS) ({})", planned.label(), source, planned.pass.kernel,
                cl_error_name(error.err()));
  }
}

}  // namespace gloam
