#include "shared/lanes/params.h"

#define STOCHASTIC_DEPTH_PARAMS(P)                                                     \
  P(int, samples, 4, 1, 16, "", "depths per pixel")                                    \
  P(float, alpha, 0.2f, 0, 1, "", "share of the samples that a surface is offered to") \
  P(choice, subset, stratified, (stratified, hashed),                                  \
    "which samples take a surface: as many as alpha says, or each by a random number of its own")

PARAMS(StochasticDepthParams, STOCHASTIC_DEPTH_PARAMS)
