#include "shared/lanes/params.h"

#define OUTLINE_MASK_PARAMS(P) \
  P(float, least_count, 2, 1, INFINITY, "", "outlines that a pixel's surface lies in from which on it is wanted")

#define OUTLINE_AO_PARAMS(P) \
  OUTLINE_MASK_PARAMS(P)     \
  P(float, occlusion, 0.25f, 0, 1, "", "what such a pixel loses")

PARAMS(OutlineMaskParams, OUTLINE_MASK_PARAMS)
PARAMS(OutlineAoParams, OUTLINE_AO_PARAMS)
