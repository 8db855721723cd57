// What gloam auto prints of effects.
#pragma once

#include "auto/report.h"

namespace gloam::cli {

/// The table of effects, and for a budget a line of what was spent.
void print(const AutoResult& result, const BudgetGoal& goal);

}  // namespace gloam::cli
