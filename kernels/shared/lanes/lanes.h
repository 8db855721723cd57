// One kernel source for CPUs (a work-item is a row of LANES pixels) and GPUs (LANES = 1).
//
// real, integer, natural, mask: one value per lane. `real` is float, or double with -D REAL_DOUBLE; a mask is as wide as
// `real`, so that it can choose between reals. scalar: one value for all lanes, of real's type.
#ifndef GLOAM_LANES_H
#define GLOAM_LANES_H

// A function that begins with MAY_FUSE may, in fast mode, round a product and the sum that it goes into once (contraction), where the
// device has an instruction for that. Elsewhere contraction is off: it would now and then move a sample to a neighbouring pixel.
#pragma OPENCL FP_CONTRACT OFF
#if defined(MATH_FAST) && !defined(REAL_DOUBLE)
#define MAY_FUSE _Pragma("OPENCL FP_CONTRACT ON")
#else
#define MAY_FUSE
#endif

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#if LANES == 1
#define N_LANES(type) type
#define ANY(m) (m)
#define IOTA 0
#else
#define N_LANES(type) JOIN(type, LANES)
#define ANY(m) any_lane(m)
#define IOTA JOIN(IOTA, LANES)
#define IOTA4 (int4)(0, 1, 2, 3)
#define IOTA8 (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#define IOTA16 (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#endif

#ifdef REAL_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double scalar;
typedef N_LANES(double) real;
#define to_real JOIN(convert_, N_LANES(double))
#if LANES == 1
typedef int mask;
#else
typedef N_LANES(long) mask;
#endif
#define REAL_INFINITY ((real)((double)INFINITY))
#else
typedef float scalar;
typedef N_LANES(float) real;
#define to_real JOIN(convert_, N_LANES(float))
typedef N_LANES(int) mask;
#define REAL_INFINITY ((real)(INFINITY))
#endif

typedef N_LANES(int) integer;
typedef N_LANES(uint) natural;
typedef N_LANES(float) stored;  // what planes hold, whatever `real` is
#define to_integer JOIN(convert_, N_LANES(int))
#define to_natural JOIN(convert_, N_LANES(uint))
#define to_stored JOIN(convert_, N_LANES(float))
#define as_integer JOIN(as_, N_LANES(int))  // the bits of a `stored`; as_stored: back
#define as_natural JOIN(as_, N_LANES(uint))
#define as_stored JOIN(as_, N_LANES(float))

// A comparison of integers as a mask for reals.
#if LANES == 1
#define to_mask(m) (m)
#else
#ifdef REAL_DOUBLE
#define to_mask(m) JOIN(convert_, N_LANES(long))(m)
#else
#define to_mask(m) (m)
#endif
#endif

#define EVERY_LANE ((mask)(LANES == 1 ? 1 : -1))
// All lanes or none. (`condition ? EVERY_LANE : (mask)(0)` chooses vectors by a scalar, which SPIR-V 1.0 cannot.)
#define EVERY_LANE_IF(condition) ((mask)((condition) ? (LANES == 1 ? 1 : -1) : 0))

#if LANES > 1
// Whether a mask holds for any lane, in one instruction; `any` takes lanes one by one on CPUs.
static inline int any_lane(mask m) {
#if LANES == 16 && defined(__AVX512DQ__) && !defined(REAL_DOUBLE)
  return __builtin_ia32_cvtd2mask512(m) != 0;
#elif LANES == 8 && defined(__AVX__) && !defined(REAL_DOUBLE)
  return __builtin_ia32_movmskps256(as_float8(m)) != 0;
#elif LANES == 4 && defined(__SSE__) && !defined(REAL_DOUBLE)
  return __builtin_ia32_movmskps(as_float4(m)) != 0;
#else
  return any(m);
#endif
}
#endif

// Per lane: all bits set where a mask holds, else none.
static inline natural bits_of(mask m) {
#if LANES == 1
  return m ? ~0u : 0u;
#else
  return JOIN(as_, N_LANES(uint))(JOIN(convert_, N_LANES(int))(m));
#endif
}

// Per lane: a mask as an integer mask, to choose between integers.
static inline integer integer_of(mask m) {
#if LANES == 1
  return m;
#else
  return JOIN(convert_, N_LANES(int))(m);
#endif
}

// Per lane: the value of the lane that `from` names, 0 to LANES - 1.
#if LANES == 1
static inline real lane_of(real v, integer from) { return v; }
#else
static inline real lane_of(real v, integer from) {
#if LANES == 16 && defined(__AVX512F__) && !defined(REAL_DOUBLE)
  return __builtin_ia32_permvarsf512(v, from);
#elif LANES == 8 && defined(__AVX2__) && !defined(REAL_DOUBLE)
  return __builtin_ia32_permvarsf256(v, from);
#elif defined(REAL_DOUBLE)
  return shuffle(v, JOIN(convert_, N_LANES(ulong))(from));
#else
  return shuffle(v, to_natural(from));
#endif
}
#endif

// Per lane: m ? a : b.
static inline real choose(mask m, real a, real b) { return m ? a : b; }

static inline integer choose_integer(mask m, integer a, integer b) { return integer_of(m) ? a : b; }

// The smaller and the larger of two, defined for infinities too (OpenCL 1.2 leaves min and max undefined there). If the first
// is NaN, the result is the second.
static inline real smaller(real a, real b) { return a < b ? a : b; }
static inline real larger(real a, real b) { return a > b ? a : b; }

// a / b, as far from it as the device's division is: half a unit in the last place on CPUs, 2.5 where OpenCL allows it and nothing else
// is asked for (-cl-fp32-correctly-rounded-divide-sqrt), as on GPUs. -D QUOTIENT_ERROR=N makes every quotient N units too large (N < 0:
// too small), so that a CPU finds what relies on the rounding.
static inline real quotient(real a, real b) {
#ifdef QUOTIENT_ERROR
#ifdef REAL_DOUBLE
  return (a / b) * (1 + (scalar)(QUOTIENT_ERROR)*0x1p-52);
#else
  return (a / b) * (1 + (scalar)(QUOTIENT_ERROR)*0x1p-23f);
#endif
#else
  return a / b;
#endif
}

// The mean of values of at most 1, from the sum of weight times value and the sum of the weights, added in the same order: at most 1, and
// exactly 1 where all values are, whatever the device's division does. (Rounding keeps order, so the sum is at most that of the weights.)
static inline real mean_up_to_one(real sum, real weights) {
  const real mean = quotient(sum, weights);
  return choose((sum < weights) & (mean < 1), mean, (real)(1));
}

typedef struct {
  real x, y, z;
} real3;
static inline real3 make3(real x, real y, real z) {
  real3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
static inline real3 scale3(real3 a, real s) { return make3(a.x * s, a.y * s, a.z * s); }
static inline real3 choose3(mask m, real3 a, real3 b) {
  return make3(choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z));
}
static inline real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

#endif
