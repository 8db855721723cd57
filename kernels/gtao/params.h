#include "shared/sampling/ambient_occlusion.h"

#define SLICE_PARAMS(P)                                                                        \
  REACH_PARAMS(P)                                                                              \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                \
  P(float, bias, 0.01f, 0, 1, "", "occluders at a lower slope above the tangent do not count") \
  P(int, steps, 9, 1, 1024, "", "samples on each side of a slice")

#define GTAO_PARAMS(P)                                                                                 \
  SLICE_PARAMS(P)                                                                                      \
  P(float, fade, 0, 0, 1, "radii", "over this outer part of the radius occluders sink to the tangent") \
  P(float, thickness_heuristic, 0, 0, 1, "",                                                           \
    "how far the horizon falls back to a sample below it; 0: occluders close everything behind them")

#define BITMASK_PARAMS(P) \
  SLICE_PARAMS(P)         \
  P(float, thickness, 0.4f, 0, INFINITY, "radii", "how far an occluder reaches behind its visible front")

// RAYS of light.h.
#define INDIRECT_PARAMS(P)                                                                                         \
  BITMASK_PARAMS(P)                                                                                                \
  P(int, rays, 2, 1, 4, "", "directions on each side of a slice in which light is looked for")                     \
  P(float, brightest, 1e20f, 0, 1e20f, "unit of color",                                                            \
    "a source of light counts up to this, in its colour: fewer fireflies beside small lamps, and less light from " \
    "them")

PARAMS(GtaoParams, GTAO_PARAMS)
PARAMS(BitmaskParams, BITMASK_PARAMS)
PARAMS(IndirectParams, INDIRECT_PARAMS)
