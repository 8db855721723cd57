#include "shared/both/params.h"

#define RESAMPLE_PARAMS(P)                                                                                            \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO to be upsampled: the unit of depth_tolerance") \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                                              \
    "distance from the tangent plane at which a neighbour no longer counts")                                          \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians",                                                         \
    "angle between normals at which a neighbour no longer counts")

PARAMS(ResampleParams, RESAMPLE_PARAMS)
