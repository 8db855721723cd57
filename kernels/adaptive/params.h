#include "shared/lanes/params.h"

#define ADAPTIVE_PARAMS(P)                  \
  P(float, least_range, 0.4f, 0, 1, "of 1", \
    "difference between the brightest and the darkest AO in and around a tile from which on it gets all samples")

PARAMS(AdaptiveParams, ADAPTIVE_PARAMS)
