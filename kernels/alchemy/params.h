#include "shared/sampling/ambient_occlusion.h"

#define SPIRAL_PARAMS(P) \
  REACH_PARAMS(P)        \
  P(int, samples, 18, 1, 2048, "", "samples per pixel, on a spiral")

#define ALCHEMY_PARAMS(P)                                                                                   \
  SPIRAL_PARAMS(P)                                                                                          \
  P(float, strength, 0.7f, 0, 8, "radii", "factor on the obscurance (sigma)")                               \
  P(float, bias, 1.5e-3f, 0, 1, "depths", "occluders lower than this above the tangent plane do not count") \
  P(float, epsilon, 0.02f, 0, 1, "squared radii", "limits what occluders close to the pixel contribute")    \
  P(int, power, 1, 1, 4, "", "exponent on the result, for contrast (k)")

#define SAO_PARAMS(P)                                                                                       \
  SPIRAL_PARAMS(P)                                                                                          \
  P(float, strength, 0.6f, 0, 8, "radii", "factor on the obscurance (sigma)")                               \
  P(float, bias, 1.5e-3f, 0, 1, "depths", "occluders lower than this above the tangent plane do not count") \
  P(float, epsilon, 0.05f, 0, 1, "squared radii", "limits what occluders close to the pixel contribute")    \
  P(int, power, 1, 1, 4, "", "exponent on the result, for contrast")                                        \
  P(bool, levels, off, "read samples that are far away on the screen from coarser levels of the depth")     \
  P(int, level_offset, 3, 0, 8, "", "levels begin at 2^(this + 1) pixels from the pixel")

PARAMS(AlchemyParams, ALCHEMY_PARAMS)
PARAMS(SaoParams, SAO_PARAMS)
