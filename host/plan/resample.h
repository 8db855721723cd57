// Estimating at a lower resolution: a plan for the whole image, turned into one for every n-th pixel each way.
#pragma once

#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// Stands for the passes that a plan adds by itself: "resample/subsample", "resample/upsample". Not in the registry; its
/// parameters are set as resample.NAME, and `reads` is what upsampling needs of the whole image.
const Technique& resampling();

/// Lets the passes of the techniques run at `plan.resolution`. What they read is subsampled before; what of theirs the
/// plan puts out is upsampled after. Reduced planes are named after the whole ones: "depth@2". Every pixel that is
/// computed is exactly one of the image, and the camera goes with it, so that positions are as exact as at full
/// resolution. `values` are those of `resampling`. Unless the outputs are to be upsampled the plan puts out the reduced ones.
void reduce(Plan& plan, const std::vector<const Technique*>& techniques, const ParameterValues& values,
            bool is_upsampled = true);

}  // namespace gloam
