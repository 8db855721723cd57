// Functions in two modes. MATH_FAST: with the maximum error stated. Otherwise exact: the same bits for every lane width and CPU
// device. What decides which pixel is read is exact in both modes.
#ifndef GLOAM_MATH_H
#define GLOAM_MATH_H

#include "shared/lanes/lanes.h"

// PoCL compiles for the CPU at hand with Clang, which defines its features. No OpenCL function compiles to exactly one of these
// instructions.
#if LANES == 16 && defined(__AVX512F__)
#define X86_NEAREST(x) __builtin_ia32_cvtps2dq512_mask(x, (integer)(0), (short)-1, 4)
#define X86_INVERSE_SQRT(x) __builtin_ia32_rsqrt14ps512_mask(x, (real)(0), (short)-1)
#define X86_INVERSE(x) __builtin_ia32_rcp14ps512_mask(x, (real)(0), (short)-1)
#elif LANES == 8 && defined(__AVX__)
#define X86_NEAREST(x) __builtin_ia32_cvtps2dq256(x)
#define X86_INVERSE_SQRT(x) __builtin_ia32_rsqrtps256(x)
#elif LANES == 4 && defined(__SSE2__)
#define X86_NEAREST(x) __builtin_ia32_cvtps2dq(x)
#define X86_INVERSE_SQRT(x) __builtin_ia32_rsqrtps(x)
#endif

// The nearest whole number, half to even, for |x| below 2^31.
static inline integer nearest(real x) {
#if defined(X86_NEAREST) && !defined(REAL_DOUBLE)
  return X86_NEAREST(x);
#else
  return to_integer(rint(x));
#endif
}

// a * b + c, for what does not decide which pixel is read.
static inline real multiply_add(real a, real b, real c) {
  MAY_FUSE
  return a * b + c;
}

// Radiance that sums can hold: negative values and NaN count as 0.
static inline real kept_radiance(real color) { return smaller(larger(color, (real)(0)), (real)(1e20f)); }

static inline real fused_dot3(real3 a, real3 b) { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }

// 2 / sqrt(x) for x > 0; the factor 2 saves the fast mode a multiplication. Fast: one lane uses the device's own, and so do several on
// a GPU, which has instructions for inverses (NATIVE_INVERSE). Several lanes of a CPU refine a guess by Newton steps: the CPU's guess
// (12 or 14 bits) by one step, relative error below 5e-7; or a guess from exponent arithmetic by a tuned and a plain step (Lomont 2003;
// constants of Kadlec 2010), relative error below 7e-7.
static inline real twice_inverse_sqrt(real x) {
#if !defined(MATH_FAST) || defined(REAL_DOUBLE)
  return quotient((real)(2), sqrt(x));
#elif LANES == 1 || defined(NATIVE_INVERSE)
  return 2 * native_rsqrt(x);
#else
#ifdef X86_INVERSE_SQRT
  const real y = X86_INVERSE_SQRT(x);
#else
  real y = as_stored((integer)0x5F1FFFF9 - (as_integer(x) >> 1));
  y *= 0.703952253f * (2.38924456f - x * y * y);
#endif
  return y * multiply_add(-x * y, y, (real)(3));
#endif
}

// As twice_inverse_sqrt; fast, and where the CPU's guess has 14 bits, without the step: relative error below 7e-5. A guess of 12 bits,
// or from exponent arithmetic, would move five times as many directions into another sector (expected_slices.h).
static inline real quick_twice_inverse_sqrt(real x) {
#if defined(MATH_FAST) && !defined(REAL_DOUBLE) && LANES == 16 && defined(X86_INVERSE_SQRT)
  return 2 * X86_INVERSE_SQRT(x);
#else
  return twice_inverse_sqrt(x);
#endif
}

static inline real inverse_sqrt(real x) { return (scalar)0.5 * twice_inverse_sqrt(x); }

// 1 / x for x > 0. Fast: relative error below 2e-7.
static inline real quick_inverse(real x) {
#if defined(MATH_FAST) && defined(NATIVE_INVERSE) && !defined(REAL_DOUBLE)
  return native_recip(x);
#elif defined(MATH_FAST) && defined(X86_INVERSE) && !defined(REAL_DOUBLE)
  const real y = X86_INVERSE(x);
  return y * multiply_add(-x, y, (real)(2));
#else
  return quotient((real)(1), x);
#endif
}

// The rough functions have the same error and the same bits in every mode and on every device. They may only decide where a
// sample lies, not what is computed from it. A guess from the exponent, then one or two steps (Lomont 2003; Moroz et al. 2021;
// constants of Kadlec 2010).

// sqrt(u), 0 <= u <= 1: relative error below 7e-4.
static inline real rough_square_root(real u) {
  const stored x = to_stored(u);
  const stored guess = as_stored((integer)0x5f1ffff9 - (as_integer(x) >> 1));
  return to_real(x * guess * (0.703952253f * (2.38924456f - x * guess * guess)));
}

// Cube root, 0 <= u <= 1: relative error below 6e-5.
static inline real rough_cube_root(real u) {
  const stored x = to_stored(u);
  const integer third = to_integer(to_stored(as_integer(x)) * 0.33333334f);
  const stored guess = as_stored((integer)0x548c2b4b - third);  // of 1 / cube root
  const stored c = x * guess * guess * guess;
  const stored inverse = guess * (1.752319676f - c * (1.2509524245f - 0.5093818292f * c));
  return to_real(x * inverse * inverse);
}

// 1 / q for q > 0: relative error below 2e-4.
static inline real rough_inverse(real q) {
  const stored x = to_stored(q);
  stored inverse = as_stored((integer)0x7ef311c7 - as_integer(x));
  inverse *= 2.0f - x * inverse;
  return to_real(inverse * (2.0f - x * inverse));
}

// |v|^2, plus a term far below any square that counts (1e-15 depths) that keeps 0/0 away where v is 0.
static inline real square_of(real3 v) {
  return multiply_add(v.x, v.x, multiply_add(v.y, v.y, multiply_add(v.z, v.z, (real)(1e-30f))));
}

static inline real3 normalise3(real3 v) { return scale3(v, inverse_sqrt(dot3(v, v))); }
// A unit vector with the same bits in every mode, for directions that decide which pixel is read.
static inline real3 exactly_normalised(real3 v) { return scale3(v, quotient((real)(1), sqrt(dot3(v, v)))); }

// Cosine and sine of a number of whole turns, 0 <= turns <= 1. Taylor polynomials about the nearest quarter turn, in
// multiplications and additions: the same bits on every device. Absolute error below 3e-7 in float, 1e-13 in double.
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
