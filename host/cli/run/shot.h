// gloam run on each frame of a shot.
#pragma once

#include "cli/run/command.h"

namespace gloam::cli {

/// Decodes, computes and writes neighbouring frames at the same time, in bounded memory. Throws Error at the end if a frame
/// failed; the others are written.
void run_on_shot(const RunCommand& flags, const PlanRequest& request);

}  // namespace gloam::cli
