#include "shared/sampling/ambient_occlusion.h"

#define HBAO_PARAMS(P)                                                                                          \
  REACH_PARAMS(P)                                                                                               \
  P(float, bias, 0.1f, 0, 1.5f, "radians", "occluders at a smaller angle above the tangent plane do not count") \
  P(int, directions, 2, 1, 64, "", "directions searched per pixel")                                             \
  P(int, steps, 9, 1, 256, "", "samples along each direction")                                                  \
  P(choice, falloff, quadratic, (quadratic, linear, none), "how an occluder fades towards the radius")          \
  P(choice, weighting, uniform, (uniform, cosine),                                                              \
    "weight of a direction: the same for all, or its cosine to the normal")

PARAMS(HbaoParams, HBAO_PARAMS)
