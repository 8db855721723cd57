// Samples where they matter: a plan that takes the same everywhere, turned into one that takes fewer where AO hardly varies.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// Stands for the pass that a plan adds by itself: "adaptive/tiles". Not in the registry; its parameters are set as
/// adaptive.NAME.
const Technique& adapting();

/// Whether a pass estimates from samples around each pixel and can leave pixels out: what `adapt` asks for.
bool is_estimate(const Pass& pass);

/// Lets the estimate of the first technique run twice: in tiles where AO varies as planned, elsewhere with the settings of
/// `preset`. Where that is, a base pass tells: the techniques' own passes on every fourth pixel each way, with the settings of
/// the preset low. `values` are those of `adapting`. To be called after `restrict_to_mask`; sets `Plan::rest`. Throws
/// UsageError for an unknown preset, a lower resolution, and techniques that look at more than the depth and normals of one
/// view or cannot leave out pixels.
void adapt(Plan& plan, const std::vector<const Technique*>& techniques, const std::string& preset,
           const ParameterValues& values);

}  // namespace gloam
