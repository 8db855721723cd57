#include "shared/filter/bilateral_params.h"
#include "shared/lanes/params.h"

#define BILATERAL_FILTER_PARAMS(P)                                     \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                   \
    "radius of the AO to be filtered: the measure of depth_tolerance") \
  BILATERAL_PARAMS(P)                                                  \
  P(choice, form, separable, (separable, square),                      \
    "along rows and then along columns, or all taps of the square at once")

PARAMS(BilateralParams, BILATERAL_FILTER_PARAMS)
