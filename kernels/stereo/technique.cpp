#include "shared/stereo/params.h"
#include "technique/stereo.h"

#define STEREO_VISIBILITY_PARAMS(P) BACK_CHECK_PARAMS(P)

#define STEREO_BILATERAL_PARAMS(P)                                                                                   \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO to be filtered: the unit of depth_tolerance") \
  STEREO_FILTER_PARAMS(P)                                                                                            \
  P(choice, form, separable, (separable, square),                                                                    \
    "one pass along rows and one along columns, or one pass over the whole square")

PARAMS(StereoVisibilityParams, STEREO_VISIBILITY_PARAMS)
PARAMS(StereoBilateralParams, STEREO_BILATERAL_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> visibility_passes(const StereoVisibilityParams&) {
  return {{.name = "visibility",
           .kernel = "stereo_seen_by_both",
           .reads = {"depth", from(From::other_view, {"other_depth", "depth"})},
           .writes = {"seen_by_both"}}};
}

std::vector<Pass> bilateral_passes(const StereoBilateralParams& p) {
  return stereo_filter_passes(p.half_width, p.form == StereoBilateralParams::form_values::square);
}

}  // namespace

std::vector<Technique> stereo() {
  return {{.name = "stereo-visibility",
           .summary = "which pixels both of two eyes see, by projection to the other eye and back",
           .paper = "Shi, Billeter, Eisemann 2022, section 3.1",
           .source = "stereo/stereo.cl",
           .reads = {"depth"},
           .writes = {"seen_by_both"},
           .views = 2,
           .parameters = StereoVisibilityParams::table(),
           .passes = passes_of(visibility_passes)},
          {.name = "stereo-bilateral",
           .summary = "bilateral filter for raw AO over both of two eyes, so that they agree",
           .paper = "Shi, Billeter, Eisemann 2022, section 3.3",
           .source = "stereo/stereo.cl",
           .reads = {"ao_raw", "depth", "normal"},
           .writes = {"ao"},
           .views = 2,
           .parameters = StereoBilateralParams::table(),
           .passes = passes_of(bilateral_passes)}};
}

}  // namespace gloam::techniques
