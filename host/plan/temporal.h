// Accumulation over time: turns a plan for one frame into one that goes on from the frame before.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// The technique of the passes that the plan itself adds after one that makes raw AO or raw indirect light: "temporal/accumulate". It is
/// not in the registry; its parameters are set as temporal.NAME.
const Technique& accumulating(const Technique& technique);
bool is_accumulating(const Technique& technique);

/// The techniques that accumulate by themselves instead of those named: temporal-sssr for sssr (`Technique::over_time`).
std::vector<std::string> over_time(std::vector<std::string> outputs);

/// Puts the mean of a technique's raw AO or light and that of the frame before between the technique and its filter. `values`: of
/// `accumulating`. `with_frames`: `frames` is put out, as it always is with the raw plane: a history needs both.
void accumulate(Plan& plan, const Technique& technique, const ParameterValues& values, bool with_frames);

/// Takes `frames` out of the outputs asked for, as no technique makes it. Returns whether it was there.
bool takes_frames(PlanRequest& request);

}  // namespace gloam
