// What an estimate has to look at of a pixel's stochastic depths, in the order in which it is soonest done: each depth once,
// without the pixel's own, the nearest first, GROUP of them side by side (ambient_occlusion.h). An estimate that takes the
// largest of all finds the same in them.
//
// in : depth          view-space z, scene units, +inf = background
//      stochastic     stack of OCCLUDERS_LAYERS depths, +inf where there is none
// out: hidden_depths  as many, in groups; +inf after the last
// -D OCCLUDERS_LAYERS
#ifndef GLOAM_HIDDEN_DEPTHS_H
#define GLOAM_HIDDEN_DEPTHS_H

#include "shared/ambient_occlusion.h"

kernel void sort_hidden_depths(Frame frame, Params params, PLANE depth, PLANE stochastic, PLANE_OUT hidden_depths) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real seen = load(depth, here);
  real sorted[OCCLUDERS_LAYERS];
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; ++k) {
    real next = load(layer_of(stochastic, frame, k), here);
    next = choose(next == seen, REAL_INFINITY, next);
#pragma unroll
    for (int j = 0; j < k; ++j) {
      const real nearer = smaller(next, sorted[j]), further = larger(next, sorted[j]);
      // What is there already does not go on.
      next = choose(nearer == further, REAL_INFINITY, further);
      sorted[j] = nearer;
    }
    sorted[k] = next;
  }
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; k += GROUP)
    store_group(sorted + k, layer_of_out(hidden_depths, frame, k), here);
}

#endif
