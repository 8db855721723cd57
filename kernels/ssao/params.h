#include "shared/sampling/ambient_occlusion.h"

#define SSAO_PARAMS(P)                                                                                          \
  REACH_PARAMS(P)                                                                                               \
  P(int, samples, 18, 1, 2048, "", "points looked at per pixel")                                                \
  P(bool, hemisphere, on, "points in the half ball above the surface; off: in the whole ball, as in the paper") \
  P(float, inner, 0, 0, 0.99f, "radii", "least distance of the points: a shell instead of a ball")              \
  P(float, bias, 0.02f, 0, 0.99f, "",                                                                           \
    "slope above the surface up to which a visible surface occludes no point of the half ball")                 \
  P(float, range, 2, 0, INFINITY, "radii",                                                                      \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")

PARAMS(SsaoParams, SSAO_PARAMS)
