#include "shared/both/params.h"

#define DIELECTRIC_PARAMS(P)             \
  P(float, reflectance, 0.04f, 0, 1, "", \
    "reflectance of every surface at normal incidence; 0.04: glass, varnish and most paints")

PARAMS(DielectricParams, DIELECTRIC_PARAMS)
