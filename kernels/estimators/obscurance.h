// What one occluder contributes: HBAO+ (NVIDIA 2016; Vermeer, Scandolo, Eisemann 2021, Algorithm 3).
#ifndef GLOAM_OBSCURANCE_H
#define GLOAM_OBSCURANCE_H

#include "shared/lanes/math.h"

// 0 to 1: cosine between the normal n (unit) and the direction v to the occluder, less the bias, fading with the squared
// distance to 0 at the radius. `inverse_square`: 1 / radius^2 in the units of v. A sample on the point itself contributes
// nothing.
static inline real obscurance(real3 v, real3 n, scalar bias, real inverse_square) {
  const real vv = square_of(v);
  const real above = multiply_add(fused_dot3(scale3(n, (scalar)0.5), v), twice_inverse_sqrt(vv), (real)(-bias));
#if NO_FALLOFF
  const real weight = choose(vv * inverse_square < 1, (real)(1), (real)(0));
#else
  const real weight = larger(multiply_add(-vv, inverse_square, (real)(1)), (real)(0));
#endif
  return larger(above, (real)(0)) * weight;
}

#endif
