#include "shared/both/params.h"

#define STOCHASTIC_DEPTH_PARAMS(P)                                                        \
  P(int, samples, 4, 1, 16, "", "depths per pixel")                                       \
  P(float, alpha, 0.2f, 0, 1, "", "share of the samples that each surface is offered to") \
  P(choice, subset, stratified, (stratified, hashed),                                     \
    "which samples are offered a surface: a stratified subset, or each by a random number of its own")

PARAMS(StochasticDepthParams, STOCHASTIC_DEPTH_PARAMS)
