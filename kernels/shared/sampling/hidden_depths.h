// A pixel's stochastic depths, prepared for estimates: each depth once, without the pixel's own, the nearest first, GROUP of them
// side by side (layers.h). An estimate that takes the largest contribution finds the same as in the unsorted ones.
//
// in : depth          view-space z, scene units, +inf = background
//      stochastic     stack of OCCLUDERS_LAYERS depths, +inf where there is none
// out: hidden_depths  as many, in groups; +inf after the last
//      low_depth      of every SCALE-th pixel each way, like the hidden depths (sort_every_hidden_depths)
// -D OCCLUDERS_LAYERS, SCALE
#ifndef GLOAM_HIDDEN_DEPTHS_H
#define GLOAM_HIDDEN_DEPTHS_H

#include "shared/sampling/ambient_occlusion.h"

// Inserts a depth into `count` sorted ones, unless it is the pixel's own or among them.
static inline void insert_hidden(real* sorted, int count, real next, real seen) {
  next = choose(next == seen, REAL_INFINITY, next);
#pragma unroll
  for (int j = 0; j < count; ++j) {
    const real nearer = smaller(next, sorted[j]), further = larger(next, sorted[j]);
    // A duplicate is replaced by nothing.
    next = choose(nearer == further, REAL_INFINITY, further);
    sorted[j] = nearer;
  }
  sorted[count] = next;
}

static inline void store_hidden(const real* sorted, Frame frame, int here, PLANE_OUT hidden_depths) {
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; k += GROUP)
    store_group(sorted + k, layer_of_out(hidden_depths, frame, k), here);
}

// in : depth, stochastic
// out: hidden_depths
kernel void sort_hidden_depths(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real seen = load(depth, here);
  real sorted[OCCLUDERS_LAYERS];
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; ++k) insert_hidden(sorted, k, load(layer_of(stochastic, frame, k), here), seen);
  store_hidden(sorted, frame, here, hidden_depths);
}

#ifdef SCALE
// `frame`: the reduced one; `other`: the one that is read.
// in : depth, stochastic
// out: low_depth, hidden_depths
kernel void sort_every_hidden_depths(ARGUMENTS) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), here = index_of(frame, FIRST_X, ROW_Y);
  const integer step = IOTA * (integer)(SCALE);
  const real seen = gather(depth + from, step);
  real sorted[OCCLUDERS_LAYERS];
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; ++k)
    insert_hidden(sorted, k, gather(layer_of(stochastic, other, k) + from, step), seen);
  store(seen, low_depth, here);
  store_hidden(sorted, frame, here, hidden_depths);
}
#endif

#endif
