// Adaptive sampling: turns a plan with the same samples everywhere into one with fewer samples where AO hardly varies.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// The technique of the passes that the plan itself adds: "adaptive/tiles". It is not in the registry; its parameters are set as
/// adaptive.NAME.
const Technique& adapting();

/// Whether a pass estimates from samples around each pixel and can skip pixels, as `adapt` requires.
bool is_estimate(const Pass& pass);

/// Runs the estimate of the first technique twice: as planned in tiles where AO varies, and elsewhere with the settings of
/// `preset`. A base pass finds the tiles: the techniques' own passes on every fourth pixel each way, with the preset low.
/// `values`: of `adapting`. Call it after `restrict_to_mask`; sets `Plan::rest`. Throws UsageError for an unknown preset, a lower
/// resolution, and techniques that read more than the depth and normals of one view or cannot skip pixels.
void adapt(Plan& plan, const std::vector<const Technique*>& techniques, const std::string& preset,
           const ParameterValues& values);

}  // namespace gloam
