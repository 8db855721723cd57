// A stochastic depth map from all surfaces under a pixel (Vermeer, Scandolo, Eisemann 2021, section 3.1): every surface is
// offered to some of the samples, and each sample keeps the nearest that it was offered.
//
// in : depth       view-space z of the nearest surface, scene units, +inf = background
//      peel        stack of all surfaces under the pixel centre, the nearest among them
// out: stochastic  stack of SAMPLES depths; +inf where a sample was offered nothing
// -D SAMPLES, HASHED, PEEL_LAYERS
#include "shared/lanes/load.h"
#include "shared/both/stochastic.h"

static inline natural subset_of(natural hash, uint alpha) {
#if HASHED
  natural subset = (natural)(0u);
  for (int j = 0; j < SAMPLES; ++j) subset |= hashed_bit(hash, (natural)((uint)j), (natural)(alpha)) << j;
  return subset;
#else
  return stratified_subset(hash, (natural)(alpha), SAMPLES);
#endif
}

// in : depth, peel
// out: stochastic
kernel void stochastic_depth_map(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const natural x = to_natural(FIRST_X + IOTA), y = (natural)((uint)ROW_Y), seed = (natural)((uint)frame.seed);
  const natural first = as_natural(to_stored(load(depth, here)));
  const uint alpha = (uint)(params.alpha * STOCHASTIC_ONE);
  real nearest[SAMPLES];
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) nearest[j] = REAL_INFINITY;
  for (int k = 0; k < PEEL_LAYERS; ++k) {
    const real surface = load(layer_of(peel, frame, k), here);
    if (!ANY(surface < REAL_INFINITY)) continue;
    const natural subset = subset_of(surface_hash(x, y, seed, as_natural(to_stored(surface)), first), alpha);
#pragma unroll
    for (int j = 0; j < SAMPLES; ++j) {
      const mask is_offered = to_mask((subset & (1u << j)) != 0u);
      nearest[j] = smaller(choose(is_offered, surface, REAL_INFINITY), nearest[j]);
    }
  }
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) store(nearest[j], layer_of_out(stochastic, frame, j), here);
}
