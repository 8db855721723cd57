// gloam run on one frame.
#pragma once

#include "cli/run/command.h"

namespace gloam::cli {

/// Runs, writes and prints. `request`: of the command's technique.
void run_on_frame(const RunCommand& flags, const PlanRequest& request);

}  // namespace gloam::cli
