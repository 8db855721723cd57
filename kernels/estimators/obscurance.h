// What one occluder contributes: HBAO+ (NVIDIA 2016; Vermeer, Scandolo, Eisemann 2021, Algorithm 3).
#ifndef GLOAM_OBSCURANCE_H
#define GLOAM_OBSCURANCE_H

#include "shared/math.h"

// 0..1: cosine of the angle between the normal n (unit) and the direction v to the occluder, above the bias, fading
// with the squared distance to 0 at the radius. `inverse_square` is 1 / radius^2 in the units of v. A sample on the
// point itself contributes nothing.
static inline real obscurance(real3 v, real3 n, scalar bias, real inverse_square) {
  const real vv = dot3(v, v);
  // Below 1e-30 (1e-15 depths) the point itself is meant; the guard keeps 0/0 away.
  const real cosine = dot3(n, v) * inverse_sqrt(max(vv, (real)(1e-30f)));
#ifdef NO_FALLOFF
  const real weight = choose(vv * inverse_square < 1, (real)(1), (real)(0));
#else
  const real weight = max(1 - vv * inverse_square, (real)(0));
#endif
  return max(cosine - bias, (real)(0)) * weight;
}

#endif
