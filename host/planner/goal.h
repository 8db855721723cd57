// A goal in words, and what is wrong with one.
#pragma once

#include <string>

#include "gloam/goal.h"

namespace gloam {

/// The option as it was given: "--budget 30ms".
std::string in_words(const Goal& goal);

/// "within 30 ms", or "within RMSE 0.02". `error`: what the error is.
std::string bound_in_words(const Goal& goal, const std::string& error);

/// Throws UsageError where both are given.
void check_one_goal(const Goal& goal);

/// Throws UsageError unless one is given. `command`: "pick".
void check_has_goal(const Goal& goal, const std::string& command);

}  // namespace gloam
