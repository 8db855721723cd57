#include "shared/both/params.h"

#define MULTI_BOUNCE_PARAMS(P)        \
  P(choice, fit, own, (own, jimenez), \
    "how reflected light grows with albedo: fitted to traced light, or the cubic of Jimenez et al. 2016")

PARAMS(MultiBounceParams, MULTI_BOUNCE_PARAMS)
