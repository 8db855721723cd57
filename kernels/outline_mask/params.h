#include "shared/both/params.h"

#define OUTLINE_MASK_PARAMS(P)                                                                                   \
  P(float, least_count, 2, 1, INFINITY, "",                                                                      \
    "a pixel is wanted if its surface lies in at least this many outlines, or their count is below 0, as where " \
    "an outline crosses itself")

#define OUTLINE_AO_PARAMS(P) \
  OUTLINE_MASK_PARAMS(P)     \
  P(float, occlusion, 0.25f, 0, 1, "", "occlusion of such a pixel")

PARAMS(OutlineMaskParams, OUTLINE_MASK_PARAMS)
PARAMS(OutlineAoParams, OUTLINE_AO_PARAMS)
