#include "shared/sampling/ambient_occlusion.h"

#define VOLUMETRIC_PARAMS(P)                                                                                    \
  REACH_PARAMS(P)                                                                                               \
  P(int, samples, 18, 1, 2048, "", "columns of the half ball per pixel")                                        \
  P(float, bias, 0.02f, 0, 0.99f, "", "slope above the surface up to which a visible surface occludes nothing") \
  P(float, range, 2, 0, INFINITY, "radii",                                                                      \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")

PARAMS(VolumetricParams, VOLUMETRIC_PARAMS)
