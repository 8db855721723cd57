#include "shared/filter/bilateral_params.h"
#include "shared/both/params.h"

#define SPECULAR_OCCLUSION_PARAMS(P)                                                                             \
  P(choice, method, sectors, (sectors, cone, lagarde),                                                           \
    "what tells where the lobe is closed: the slices of an AO technique, its bent normal and cone, or AO alone") \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO technique: the unit of depth_tolerance")  \
  P(int, half_width, 2, 0, 32, "pixels",                                                                         \
    "taps of the filter on either side of the pixel, along each axis; lagarde is not filtered, as its AO is")    \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                                         \
    "distance from the tangent plane at which a tap no longer counts")                                           \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians", "angle between normals at which a tap no longer counts")

PARAMS(SpecularOcclusionParams, SPECULAR_OCCLUSION_PARAMS)
