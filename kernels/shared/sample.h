// Where to look, and with which random numbers: a counter-based hash of (pixel, sample, seed), so that the same seed
// gives the same image on every device and lane width.
#ifndef GLOAM_SAMPLE_H
#define GLOAM_SAMPLE_H

#include "shared/camera.h"
#include "shared/math.h"

// lowbias32 (Wellons 2018).
static inline natural hash(natural h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

static inline natural pixel_hash(integer x, int y, int seed) {
  return hash(to_natural(x) + hash((natural)((uint)y) + hash((natural)((uint)seed))));
}

// 24 bits of a hash as 0 <= u < 1: exact in float.
static inline real unit_random(natural h) { return to_real(h >> 8) * (scalar)0x1p-24; }

// How far a radius in scene units reaches on the screen, in pixels of each axis, capped; and in units of the depth.
typedef struct {
  real pixels_x, pixels_y;
  real inverse_square;  // 1 / (radius / depth)^2
} Reach;

// A radius of 0 reaches no pixel; an infinite one every pixel up to the cap. Distances of 1e15 depths and more are out
// of any reach, so that background never counts, not even for an infinite radius.
static inline Reach reach_of(Anchor a, scalar radius, scalar most_pixels) {
  Reach r;
  const real relative = (scalar)radius * a.inverse_depth;
  r.pixels_x = min(relative / a.across_x, (real)(most_pixels));
  r.pixels_y = min(relative / a.across_y, (real)(most_pixels));
  const real inverse = max((scalar)1 / max(relative, (real)(1e-18f)), (real)(1e-15f));
  r.inverse_square = inverse * inverse;
  return r;
}

#endif
