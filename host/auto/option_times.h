// The times of options of effects on a frame, before they are run on it.
#pragma once

#include <vector>

#include "auto/budget.h"

namespace gloam {

/// Runs a plan, three times at least.
RunResult timed(const Plan& plan, const Frame& frame, const BudgetMeans& means);
/// The same of an option's plan; of one that the look has computed, what is left to do. On a frame other than that of the look, which is for its
/// time, nothing was seen.
RunResult timed(const EffectOption& option, const Plan& plan, const Frame& frame, const BudgetMeans& means);

/// Measures the options that the table cannot tell the time of on few of the frame's pixels, at two sizes, and states the expected time of all.
void expect_times(std::vector<BudgetedEffect>& effects, const BudgetMeans& means, OptionSpeeds& speeds);

}  // namespace gloam
