// What techniques for two eyes have in common (Shi, Billeter, Eisemann 2022), whatever they estimate.
#pragma once

#include <string>
#include <vector>

#include "gloam/technique.h"

namespace gloam {

/// The technique `mono` for two eyes: "stereo-" before its name, STEREO_PARAMS (shared/stereo/params.h) after its parameters, and no
/// extras. The last of its passes is the estimate, from "depth" and "normal" (its first two reads) to "ao_raw" or "indirect_raw". `both`
/// is the kernel for both eyes, `both`_list the one for a list of pixels. Their arguments are the estimate's, with stereo_depth
/// (shared/stereo/passes.h) instead of the depth, the list, and the same planes of the other eye except normals; the first may also
/// read other_half_occluded (shared/stereo/half_occlusion.h). The filter, which follows `mono`, is one of its passes.
Technique over_two_eyes(Technique mono, const std::string& both);

/// The filter over both eyes: one pass along rows and one along columns, or one over a square. Kernels:
/// shared/filter/bilateral_filter.h, shared/stereo/filter.h.
std::vector<Pass> stereo_filter_passes(int half_width, bool is_square, const std::string& raw = "ao_raw",
                                       const std::string& result = "ao");

}  // namespace gloam
