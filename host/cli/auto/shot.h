// gloam auto on each frame of a shot.
#pragma once

#include "cli/auto/command.h"

namespace gloam::cli {

/// Decides for each frame by itself, at one radius for all, and tells in which frames each effect was wanted. Throws Error at the
/// end if a frame failed; the others are written.
void run_auto_on_shot(const AutoCommand& flags);

}  // namespace gloam::cli
