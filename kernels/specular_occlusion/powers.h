// Powers, by additions, multiplications and one division: the same bits on every device.
#ifndef GLOAM_SPECULAR_OCCLUSION_POWERS_H
#define GLOAM_SPECULAR_OCCLUSION_POWERS_H

#include "shared/lanes/math.h"

// 2^n for whole n of -126 to 127.
static inline real power_of_two(integer n) { return to_real(as_stored((n + 127) << 23)); }

// log2(x) for 1e-30 to 1e30: absolute error below 3e-7 in float, 3e-9 in double; 0 for 1.
static inline real binary_logarithm(real x) {
  // The exponent for which the rest lies between the root of a half and that of 2.
  const integer n = (as_integer(to_stored(x)) - as_integer((stored)(0.70710678f))) >> 23;
  const real m = x * power_of_two(-n), t = (m - 1) / (m + 1), square = t * t;
  const real series =
      1 + square * ((scalar)(1.0 / 3) +
                    square * ((scalar)(1.0 / 5) + square * ((scalar)(1.0 / 7) + square * (scalar)(1.0 / 9))));
  return to_real(n) + t * series * (scalar)2.885390081777927;
}

// 2^x: relative error below 3e-7 in float, 6e-9 in double; 1 for 0. Below -100 as for -100, above 100 as for 100.
static inline real binary_power(real x) {
  const real within = smaller(larger(x, (real)(-100)), (real)(100)), whole = floor(within + (scalar)0.5);
  const real r = (within - whole) * (scalar)0.6931471805599453;
  const real series =
      1 + r * (1 + r * ((scalar)(1.0 / 2) +
                        r * ((scalar)(1.0 / 6) +
                             r * ((scalar)(1.0 / 24) +
                                  r * ((scalar)(1.0 / 120) + r * ((scalar)(1.0 / 720) + r * (scalar)(1.0 / 5040)))))));
  return series * power_of_two(to_integer(whole));
}

// x^p for x >= 0 and p > 0.
static inline real power(real x, real p) {
  const mask is_there = x > (scalar)1e-30f;
  return choose(is_there, binary_power(p * binary_logarithm(choose(is_there, x, (real)(1)))), (real)(0));
}

#endif
