#include "shared/filter/bilateral_params.h"
#include "shared/both/params.h"

#define BILATERAL_FILTER_PARAMS(P)                                        \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                      \
    "radius of the estimate to be filtered: the unit of depth_tolerance") \
  BILATERAL_PARAMS(P)                                                     \
  P(choice, form, separable, (separable, square),                         \
    "one pass along rows and one along columns, or one pass over the whole square")

PARAMS(BilateralParams, BILATERAL_FILTER_PARAMS)
