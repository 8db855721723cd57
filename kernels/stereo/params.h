#include "shared/stereo/params.h"

#define STEREO_VISIBILITY_PARAMS(P) BACK_CHECK_PARAMS(P)

#define STEREO_BILATERAL_PARAMS(P)                                                                                   \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO to be filtered: the unit of depth_tolerance") \
  STEREO_FILTER_PARAMS(P)                                                                                            \
  P(choice, form, separable, (separable, square),                                                                    \
    "one pass along rows and one along columns, or one pass over the whole square")

PARAMS(StereoVisibilityParams, STEREO_VISIBILITY_PARAMS)
PARAMS(StereoBilateralParams, STEREO_BILATERAL_PARAMS)
