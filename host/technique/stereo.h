// What techniques for two eyes have in common (Shi, Billeter, Eisemann 2022), whatever they estimate.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/technique.h"

namespace gloam {

/// The choices of STEREO_PARAMS (shared/stereo/params.h).
struct StereoChoices {
  bool estimate_both = true;  ///< estimate from both eyes' depths, not from one
  bool reproject = true, back_check = true;
  enum class Filter { mono, stereo, stereo2d } filter = Filter::stereo;
  int primary = 0;  ///< the view that is estimated first
  int half_width = 0;
  bool everywhere = false;  ///< use the other eye for every pixel, not only near surfaces that only it sees
  bool near_half_occluded() const { return estimate_both && !everywhere; }
};

/// The passes of a technique for two eyes. `mono`: its passes for one eye; the last is the estimate, from "depth" and "normal"
/// (its first two reads) to "ao_raw" or "indirect_raw". `both` is the kernel for both eyes, `both`_list the one for a list of pixels. Their
/// arguments are the estimate's, with stereo_depth (shared/stereo/passes.h) instead of the depth, the list, and the same planes
/// of the other eye except normals; the first may also read other_half_occluded (shared/stereo/half_occlusion.h). Extras are not
/// made.
std::vector<Pass> stereo_passes(std::vector<Pass> mono, const std::string& both, const StereoChoices& choices);

/// The technique `mono` for two eyes: "stereo-" before its name, with parameters and passes of its own, and no extras. The
/// filter, which follows `mono`, is one of its passes.
Technique over_two_eyes(Technique mono, ParameterList parameters,
                        std::function<std::vector<Pass>(const ParameterValues&)> passes);

/// The filter alone. Kernels: shared/filter/bilateral_filter.h, shared/stereo/filter.h.
std::vector<Pass> stereo_filter_passes(StereoChoices::Filter filter, int half_width, const std::string& raw = "ao_raw",
                                       const std::string& result = "ao");

template <typename Params>
StereoChoices stereo_choices(const Params& p) {
  StereoChoices c;
  c.estimate_both = p.estimate == Params::estimate_values::stereo;
  c.reproject = p.reproject != Params::reproject_values::off;
  c.back_check = p.reproject != Params::reproject_values::no_back_check;
  c.filter = StereoChoices::Filter(p.filter);
  c.primary = p.primary;
  c.half_width = p.half_width;
  c.everywhere = p.other_eye == Params::other_eye_values::everywhere;
  return c;
}

}  // namespace gloam
