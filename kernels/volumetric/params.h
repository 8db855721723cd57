#include "shared/sampling/ambient_occlusion.h"

#define VOLUMETRIC_PARAMS(P)                                                                               \
  REACH_PARAMS(P)                                                                                          \
  P(int, samples, 18, 1, 2048, "", "columns of the half ball per pixel")                                   \
  P(float, bias, 0.02f, 0, 0.99f, "", "slope above the surface up to which what is seen occludes nothing") \
  P(float, range, 2, 0, INFINITY, "radii",                                                                 \
    "how far before the pixel's point an occluder counts in full; nothing from twice that on")

PARAMS(VolumetricParams, VOLUMETRIC_PARAMS)
