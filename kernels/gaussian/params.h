#include "shared/both/params.h"

#define GAUSSIAN_PARAMS(P)                                                   \
  P(float, sigma, 1.5f, 0, 64, "pixels", "standard deviation; 0: no filter") \
  P(int, half_width, 4, 0, 32, "pixels", "taps on either side of the pixel, along each axis")

PARAMS(GaussianParams, GAUSSIAN_PARAMS)
