#include "shared/rays/environment_params.h"
#include "shared/sampling/ambient_occlusion.h"

#define EVIDENCE_PARAMS(P)                                                                          \
  REACH_PARAMS(P)                                                                                   \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                     \
  P(float, bias, 0.01f, 0, 1, "", "slope above the tangent below which an occluder does not count") \
  P(int, steps, 9, 1, 64, "", "samples on each side of a slice")                                    \
  P(file, coefficients,                                                                             \
    "coefficients fitted to scenes of your own, as `bench_fit` writes them; none: the built-in "    \
    "ones")

// Not of two eyes.
#define EVIDENCE_EDGE_PARAMS(P)                                                                                   \
  P(int, edge_factor, 4, 1, 16, "",                                                                               \
    "how many times as many slices are searched at pixels that no filter averages, as their four neighbours are " \
    "other surfaces")

// `rays`: RAYS of missing_light.h.
#define ENVIRONMENT_LIGHT_PARAMS(P)                                                                                 \
  P(choice, method, slices, (slices, bent_normal, normal),                                                          \
    "what tells which light arrives: the closed directions of each slice, or ambient occlusion as a factor on the " \
    "light on a surface that faces the mean open direction (bent_normal) or the normal's")                          \
  P(int, rays, 2, 1, 4, "", "directions on each side of a slice in which light is read; of slices")                 \
  ENVIRONMENT_PARAMS(P, "even light of radiance 1")

PARAMS(EvidenceParams, EVIDENCE_PARAMS)
PARAMS(EvidenceEdgeParams, EVIDENCE_EDGE_PARAMS)
PARAMS(EnvironmentParams, ENVIRONMENT_LIGHT_PARAMS)
