#include "shared/rays/environment_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/stereo/params.h"

#define EVIDENCE_SLICE_PARAMS(P)                                                                    \
  REACH_PARAMS(P)                                                                                   \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                     \
  P(float, bias, 0.01f, 0, 1, "", "slope above the tangent below which an occluder does not count") \
  P(int, steps, 9, 1, 64, "", "samples on each side of a slice")                                    \
  P(file, coefficients,                                                                             \
    "coefficients fitted to scenes of your own, as `bench_fit` writes them; none: the built-in "    \
    "ones")

#define EVIDENCE_EDGE_PARAMS(P)                                                                                   \
  P(int, edge_factor, 4, 1, 16, "",                                                                               \
    "how many times as many slices are searched at pixels that no filter averages, as their four neighbours are " \
    "other surfaces")

#define EVIDENCE_PARAMS(P) \
  EVIDENCE_SLICE_PARAMS(P) \
  EVIDENCE_EDGE_PARAMS(P)

// `rays`: RAYS of missing_light.h.
#define ENVIRONMENT_LIGHT_PARAMS(P)                                                                                 \
  EVIDENCE_PARAMS(P)                                                                                                \
  P(choice, method, slices, (slices, bent_normal, normal),                                                          \
    "what tells which light arrives: the closed directions of each slice, or ambient occlusion as a factor on the " \
    "light on a surface that faces the mean open direction (bent_normal) or the normal's")                          \
  P(int, rays, 2, 1, 4, "", "directions on each side of a slice in which light is read; of slices")                 \
  ENVIRONMENT_PARAMS(P, "even light of radiance 1")

#define SD_EVIDENCE_PARAMS(P) \
  EVIDENCE_PARAMS(P)          \
  STOCHASTIC_PARAMS(P)

#define STEREO_EVIDENCE_PARAMS(P) \
  EVIDENCE_SLICE_PARAMS(P)        \
  STEREO_PARAMS(P)

PARAMS(EvidenceParams, EVIDENCE_PARAMS)
PARAMS(EnvironmentParams, ENVIRONMENT_LIGHT_PARAMS)
PARAMS(SdEvidenceParams, SD_EVIDENCE_PARAMS)
PARAMS(StereoEvidenceParams, STEREO_EVIDENCE_PARAMS)
