#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"

#define MULTIRES_PARAMS(P)                                                                     \
  REACH_PARAMS(P)                                                                              \
  P(int, levels, 5, 1, 8, "", "resolutions: the whole one, a half, a quarter, ...")            \
  P(int, samples, 10, 1, 512, "", "samples per pixel of each resolution")                      \
  OBSCURANCE_BIAS(P)                                                                           \
  OBSCURANCE_STRENGTH(P)                                                                       \
  OBSCURANCE_FALLOFF(P)                                                                        \
  P(choice, combine, maximum, (maximum, maximum_and_mean),                                     \
    "how resolutions are combined: the largest occlusion, or that and the mean of all")        \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                       \
    "distance from the tangent plane at which a pixel of a lower resolution no longer counts") \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians",                                  \
    "angle between normals at which a pixel of a lower resolution no longer counts")

PARAMS(MultiresParams, MULTIRES_PARAMS)
