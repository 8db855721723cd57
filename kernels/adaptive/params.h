#include "shared/both/params.h"

#define ADAPTIVE_PARAMS(P)              \
  P(float, least_range, 0.4f, 0, 1, "", \
    "a tile gets all samples if the brightest and the darkest AO in and around it differ by at least this")

PARAMS(AdaptiveParams, ADAPTIVE_PARAMS)
