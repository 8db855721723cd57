#include "shared/params.h"

#define BILATERAL_PARAMS(P)                                                                                            \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                                                                   \
    "radius of the AO to be filtered: the measure of depth_tolerance")                                                 \
  P(int, half_width, 4, 0, 32, "pixels", "taps on either side of the pixel, along each axis")                          \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                                               \
    "distance from the tangent plane at which a tap no longer counts")                                                 \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians", "angle between normals at which a tap no longer counts") \
  P(choice, form, separable, (separable, square),                                                                      \
    "along rows and then along columns, or all taps of the square at once")

PARAMS(BilateralParams, BILATERAL_PARAMS)
