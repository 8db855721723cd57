// --budget and --error of gloam auto.
#pragma once

#include <string>

#include "cli/auto/frame.h"

namespace gloam::cli {

/// The flag as it was given: "--budget 30ms".
std::string in_words(const BudgetGoal& goal);

/// Throws UsageError for a frame that effects cannot be weighed on.
void check_goal(const BudgetGoal& goal, const AutoFrame& planned);

/// One line where a budget was missed; empty if it was not.
std::string note_on_goal(const Spent& spent, const BudgetGoal& goal);

}  // namespace gloam::cli
