// Planes of a plan that lie in the memory of others, which no later pass reads.
#pragma once

#include <map>
#include <string>

#include "gloam/plan.h"
#include "plan/layouts.h"

namespace gloam {

/// Plane -> the earlier plane in whose memory it lies: one of the same size, number of components and value outside the image, which is
/// read for the last time by an earlier pass than the first one that writes the plane. Planes that are not named have memory of their own:
/// among them inputs, outputs, stacks, bits and lists, which are read when all passes have run, and all planes of a plan with key views,
/// whose passes read those of earlier views.
std::map<std::string, std::string> shared_memory(const Plan& plan, const Layouts& layouts);

/// Bytes of all planes and stacks of one view, memory that planes share counted once. `in_place`: leaves out the inputs that are no stacks.
unsigned long long bytes_of_planes(const Plan& plan, const Layouts& layouts, bool in_place = false);

}  // namespace gloam
