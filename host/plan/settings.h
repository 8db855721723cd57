// Values of the parameters of a plan's techniques: defaults, presets, settings, and values that one technique passes on to another.
#pragma once

#include <string>
#include <vector>

#include "plan/wanted.h"

namespace gloam {

/// Values for each technique of `order`. `main`: the plan's name, for messages. `restricted`, `mask`: the technique that a mask
/// restricts (null: none), and the mask's plane. Throws UsageError for a preset or setting that reaches no technique, or whose
/// value is not allowed.
std::vector<ParameterValues> values_of(const PlanRequest& request, const Techniques& order, const std::string& main,
                                       const Technique* restricted, const std::string& mask);

/// The planes that a technique reads with the request's settings.
std::vector<std::string> reads_of(const Technique& technique, const PlanRequest& request);

}  // namespace gloam
