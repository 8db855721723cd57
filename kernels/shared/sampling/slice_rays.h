// Where directions on a side of a slice lie in the ranges that they stand for.
// -D JITTER
#ifndef GLOAM_SLICE_RAYS_H
#define GLOAM_SLICE_RAYS_H

#include "shared/sampling/sample.h"

// Where the rays of a pixel's first slice lie in their ranges: the nine pixels of any 3 x 3 have the nine ninths (columns 1/3, rows 1/9),
// so that a small filter averages all elevations. Lattices of irrational steps beside those of sample.h read an SSIM lower by up to
// .014. From seed to seed they step by the fraction of e, of whose first multiples none comes near one of the steps of sample.h: else
// the same elevations would always come with the same slices.
static inline real shift_of_rays(natural x, natural y, int seed) {
#if JITTER
  return unit_random(x * 0x55555556u + (y * 0x1c71c71du + (uint)seed * 0xb7e15162u));
#else
  return (real)(0.5f);
#endif
}

// In slice d: moved on by the golden section.
static inline real shift_of_slice(real shift, int d) {
  const real moved = shift + (scalar)d * (scalar)0.6180339887f;
  return moved - floor(moved);
}

#endif
