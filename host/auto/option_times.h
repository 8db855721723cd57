// The times of options of effects on a frame, before they are run on it.
#pragma once

#include <vector>

#include "auto/budget.h"

namespace gloam {

/// Runs a plan, three times at least.
RunResult timed(const Plan& plan, const Frame& frame, const BudgetMeans& means);

/// Measures the options that the table cannot tell the time of on few of the frame's pixels, at two sizes, and states the expected time of all.
void expect_times(std::vector<BudgetedEffect>& effects, const BudgetMeans& means, OptionSpeeds& speeds);

}  // namespace gloam
