#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/mask_params.h"

#define CORNER_MASK_PARAMS(P)                                                                    \
  REACH_PARAMS(P)                                                                                \
  MASK_SEARCH_PARAMS(P)                                                                          \
  P(float, range, 0, 0, INFINITY, "radii",                                                       \
    "something occludes up to twice this before the point, or up to the radius if that is more") \
  MASK_CELL(P)

#define HIDDEN_MASK_PARAMS(P) \
  CORNER_MASK_PARAMS(P)       \
  P(int, samples, 4, 1, 16, "", "stochastic depths per pixel")

PARAMS(CornerMaskParams, CORNER_MASK_PARAMS)
PARAMS(HiddenMaskParams, HIDDEN_MASK_PARAMS)
