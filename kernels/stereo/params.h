#include "shared/lanes/params.h"
#include "shared/stereo/params.h"

#define STEREO_VISIBILITY_PARAMS(P) BACK_CHECK_PARAMS(P)

#define STEREO_BILATERAL_PARAMS(P)                                     \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                   \
    "radius of the AO to be filtered: the measure of depth_tolerance") \
  STEREO_FILTER_PARAMS(P)                                              \
  P(choice, form, separable, (separable, square),                      \
    "along rows and then along columns, or all taps of the square at once")

PARAMS(StereoVisibilityParams, STEREO_VISIBILITY_PARAMS)
PARAMS(StereoBilateralParams, STEREO_BILATERAL_PARAMS)
