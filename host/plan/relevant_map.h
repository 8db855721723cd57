// Maps of relevant surfaces, and techniques that they do not serve.
#pragma once

#include "gloam/plan.h"

namespace gloam {

/// Throws UsageError if a plan makes a stochastic depth map of relevant surfaces and reads that of one view for the other: what only the
/// one view shows looks for occluders that the other's map leaves out.
void check_made_map(const Plan& plan);

}  // namespace gloam
