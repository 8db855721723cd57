// Why an option is the one for a goal, in words.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/figures.h"

namespace gloam {

/// How options are spoken of.
struct OptionWords {
  std::function<std::string(size_t)> label;  ///< of an option, by its index
  std::string error = "RMSE";                ///< what the error is
  std::string truth = "the truth";           ///< what the error is to
};

/// A sentence: "the most accurate within 20 ms: gtao, medium, full with 15.10 ms and RMSE 0.0831; the next faster, gtao, low, full, takes
/// 9.20 ms and errs 12 % more". The next faster one is the most accurate of those that take less time and err more; where there is none, and the
/// goal is a time, the most accurate of the others within it is named.
std::string why_chosen(const std::vector<Figures>& all, size_t chosen, const Goal& goal, const OptionWords& words);

/// Where nothing is within the goal, which misses it least: "--budget 1ms: nothing is that fast on this device; the fastest is gtao, low,
/// full with 3.20 ms".
std::string why_none(const std::vector<Figures>& all, const Goal& goal, const OptionWords& words);

}  // namespace gloam
