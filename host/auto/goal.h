// A budget or an error as the goal of gloam auto, in words.
#pragma once

#include <string>

#include "gloam/auto.h"

namespace gloam {

/// The flag as it was given: "--budget 30ms".
std::string in_words(const BudgetGoal& goal);

}  // namespace gloam
