#include "shared/sampling/ambient_occlusion.h"

#define CORNER_MASK_PARAMS(P)                                                                          \
  REACH_PARAMS(P)                                                                                      \
  P(int, search_directions, 8, 1, 32, "", "directions searched from the pixel that stands for a cell") \
  P(int, search_steps, 3, 1, 32, "", "samples along each direction")                                   \
  P(float, least_sine, 0.02f, 0.001f, 1, "",                                                           \
    "something occludes if the sine of its elevation over the tangent plane is at least this")         \
  P(float, range, 0, 0, INFINITY, "radii",                                                             \
    "something occludes up to twice this before the point, or up to the radius if that is more")       \
  P(int, cell, 4, 2, 16, "pixels", "width and height of a cell of the mask")

#define HIDDEN_MASK_PARAMS(P) \
  CORNER_MASK_PARAMS(P)       \
  P(int, samples, 4, 1, 16, "", "stochastic depths per pixel")

PARAMS(CornerMaskParams, CORNER_MASK_PARAMS)
PARAMS(HiddenMaskParams, HIDDEN_MASK_PARAMS)
