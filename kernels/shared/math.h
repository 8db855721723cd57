// Functions with two prices. MATH_FAST: stated maximum error. Otherwise exact, so that every lane width and every CPU
// device gives the same bits. Whatever decides which pixel is read stays exact in both modes.
#ifndef GLOAM_MATH_H
#define GLOAM_MATH_H

#include "shared/lanes.h"

// 1 / sqrt(x) for x > 0.
// Fast: on lanes, initial guess by exponent arithmetic with one tuned and one plain Newton step (Lomont 2003; constants
// of Kadlec 2010), relative error below 7e-7; on one lane the device's own.
static inline real inverse_sqrt(real x) {
#if !defined(MATH_FAST) || defined(REAL_DOUBLE)
  return (scalar)1 / sqrt(x);
#elif LANES == 1
  return native_rsqrt(x);
#else
  real y = JOIN(as_, N_LANES(float))((integer)0x5F1FFFF9 - (JOIN(as_, N_LANES(int))(x) >> 1));
  y *= 0.703952253f * (2.38924456f - x * y * y);
  return y * (1.5f - 0.5f * x * y * y);
#endif
}

static inline real3 normalise3(real3 v) { return scale3(v, inverse_sqrt(dot3(v, v))); }

// Cosine and sine of a number of whole turns, 0 <= turns <= 1. Taylor polynomials about the nearest quarter turn, in
// plain multiplications and additions: the same bits everywhere. Absolute error below 3e-7 in float, 1e-13 in double.
static inline void cosine_sine_of_turns(real turns, real* cosine, real* sine) {
  const real quarter = floor(turns * 4 + (scalar)0.5);
  const real a = (turns - quarter * (scalar)0.25) * (scalar)6.283185307179586;  // -pi/4 .. pi/4
  const real b = a * a;
#ifdef REAL_DOUBLE
  const real c =
      1 + b * (-1.0 / 2 +
               b * (1.0 / 24 + b * (-1.0 / 720 + b * (1.0 / 40320 + b * (-1.0 / 3628800 + b * (1.0 / 479001600))))));
  const real s =
      a * (1 + b * (-1.0 / 6 +
                    b * (1.0 / 120 +
                         b * (-1.0 / 5040 + b * (1.0 / 362880 + b * (-1.0 / 39916800 + b * (1.0 / 6227020800)))))));
#else
  const real c = 1 + b * (-1.0f / 2 + b * (1.0f / 24 + b * (-1.0f / 720 + b * (1.0f / 40320))));
  const real s = a * (1 + b * (-1.0f / 6 + b * (1.0f / 120 + b * (-1.0f / 5040 + b * (1.0f / 362880)))));
#endif
  const integer q = to_integer(quarter) & 3;
  const mask swap = to_mask((q & 1) != 0);
  const real x = choose(swap, s, c), y = choose(swap, c, s);
  *cosine = choose(to_mask((q == 1) | (q == 2)), -x, x);
  *sine = choose(to_mask(q >= 2), -y, y);
}

#endif
