// The effects that a frame may call for.
#pragma once

#include "gloam/auto.h"

namespace gloam {

/// What may run on the frame without its unfit planes, and what to decode for it. Throws as `plan_auto` does.
void plan_effects(AutoPlan& planned, const PlanRequest& asked, const AutoPurpose& purpose);

}  // namespace gloam
