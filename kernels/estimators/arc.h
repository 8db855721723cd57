// What an occluder takes from one side of a slice: everything below it, so that the highest one counts (Jimenez, Wu, Pesce,
// Jarabo 2016, equation 7, from the tangent instead of the line to the eye).
#ifndef GLOAM_ARC_H
#define GLOAM_ARC_H

#include "shared/sampling/slice.h"

// Elevations are kept as cotangents: one division, exact for flat ones, no angle; in fast mode as fractions, which are compared without
// a division.
typedef struct {
  real along, above;  // above > 0; 1 where the cotangent itself is kept
} Horizon;

// 0 degrees.
static inline Horizon no_horizon(void) {
  Horizon h;
  h.along = (real)(1e9f);
  h.above = (real)(1);
  return h;
}

static inline real cotangent_of(Horizon h) {
#ifdef MATH_FAST
  return h.along * quick_inverse(h.above);
#else
  return h.along;
#endif
}

// Raises the horizon to a point `along` the tangent and `above` it, where the point `counts`; above > 0 there.
static inline void raise(Horizon* h, real along, real above, mask counts) {
#ifdef MATH_FAST
  const mask higher = counts & (along * h->above < h->along * above);
  h->along = choose(higher, along, h->along);
  h->above = choose(higher, above, h->above);
#else
  h->along = choose(counts, smaller(along * quick_inverse(above), h->along), h->along);
#endif
}

// As `raise`, but a sample below the horizon lowers it by `share` of the difference in cosines (thickness heuristic,
// section 5.2): thin occluders do not close everything behind them.
static inline void raise_or_lower(Horizon* h, real along, real above, scalar share, mask counts) {
  MAY_FUSE
  const real horizon = h->along, point = along * quick_inverse(above);
  const real own = horizon * inverse_sqrt(multiply_add(horizon, horizon, (real)(1)));
  const real lower = point * inverse_sqrt(multiply_add(point, point, (real)(1)));
  const real cosine = own + (lower - own) * share;
  const real drawn = cosine * inverse_sqrt(larger(1 - cosine * cosine, (real)(1e-18f)));
  h->along = choose(counts, choose(point < horizon, point, drawn), horizon);
}

// Share of a slice's mass below the elevation with this cotangent. (cosine, sine): how far the normal leans towards this side.
static inline real share_below(real horizon, real cosine, real sine, real mass) {
  const real inverse = inverse_sqrt(multiply_add(horizon, horizon, (real)(1)));
  return mass_below(horizon * inverse, inverse * inverse, cosine, sine) * ((scalar)0.5 * quick_inverse(mass));
}

// The same below an elevation by its cosine.
static inline real share_below_cosine(real c, real cosine, real sine, real mass) {
  return mass_below(c, multiply_add(-c, c, (real)(1)), cosine, sine) * ((scalar)0.5 * quick_inverse(mass));
}

#endif
