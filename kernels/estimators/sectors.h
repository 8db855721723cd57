// What an occluder of some thickness takes from one side of a slice: the sectors between its front and its back (Therrien,
// Levesque, Gilet 2023, section 3). Sectors here have equal cosine-weighted mass: the share of open ones is the result.
#ifndef GLOAM_SECTORS_H
#define GLOAM_SECTORS_H

#include "shared/sampling/slice.h"

// Sectors of a slice. A little more than one below the bits of a mask: no shift reaches all of them, whatever the rounding.
#define SECTORS ((scalar)30.9f)
#define MOST_SECTORS ((scalar)31.9f)  // with the shift

// How the mass on one side of a slice is divided into sectors.
typedef struct {
  real cosine, sine;  // of the normal's lean towards this side, times SECTORS / (2 mass)
  real shift;         // 0 to just below 1: start of the count, so that rounding is unbiased
} Scale;

static inline Scale scale_of(real cosine, real sine, real mass, real shift) {
  const real per_mass = SECTORS * (scalar)0.5 * quick_inverse(mass);
  Scale s;
  s.cosine = cosine * per_mass;
  s.sine = sine * per_mass;
  s.shift = shift * (scalar)0.999;
  return s;
}

// Number of sectors up to the elevation whose cotangent is `horizon` (arc.h), plus the shift.
static inline real sectors_below_horizon(real horizon, Scale s) {
  const real inverse = inverse_sqrt(multiply_add(horizon, horizon, (real)(1)));
  return mass_below(horizon * inverse, inverse * inverse, s.cosine, s.sine) + s.shift;
}

// Number of sectors up to a point `along` the tangent and `above` it, above >= 0, plus the shift.
static inline real sectors_below(real along, real above, Scale s) {
  const real square = multiply_add(along, along, multiply_add(above, above, (real)(1e-30f)));
  const real inverse = inverse_sqrt(square), sine = above * inverse;
  return mass_below(along * inverse, sine * sine, s.cosine, s.sine) + s.shift;
}

// As sectors_below, in less time: a cubic of the elevation's cosine c. With arc_mass(c) close to c (2.06 - .489 c^2), exact at 0 and
// 1, mass_below is one; off by up to .15 sectors of a whole slice.
typedef struct {
  real fixed, linear, square, cubic;  // of twice the cosine, which inverse_sqrt gives for less
} QuickScale;

static inline QuickScale quick_scale_of(Scale s) {
  QuickScale q;
  q.fixed = s.cosine + s.sine * HALF_PI + s.shift;
  q.linear = s.sine * (scalar)(-0.5 * 2.0597963);
  q.square = s.cosine * (scalar)-0.25;
  q.cubic = s.sine * (scalar)(0.125 * 0.489);
  return q;
}

// A side with a smaller share of the slice would have so many sectors of its own that the error could take a count below -1, which
// is no shift.
#define LEAST_QUICK_SHARE ((scalar)0.05f)

// Number of sectors up to an elevation, plus the shift; at least -.9, which as a whole number is 0.
static inline real quick_sectors_below(real twice_cosine, QuickScale q) {
  const real c = twice_cosine;
  return multiply_add(c, multiply_add(c, multiply_add(c, q.cubic, q.square), q.linear), q.fixed);
}

// One bit for each whole sector from `low` to `high`.
static inline natural sectors_between(real low, real high) {
  return ((natural)(1u) << to_natural(to_integer(high))) - ((natural)(1u) << to_natural(to_integer(low)));
}

// Number of bits; OpenCL's popcount takes lanes one by one on CPUs.
static inline real count_of(natural m) {
  m -= (m >> 1) & 0x55555555u;
  m = (m & 0x33333333u) + ((m >> 2) & 0x33333333u);
  m = (m + (m >> 4)) & 0x0f0f0f0fu;
  return to_real((m * 0x01010101u) >> 24);
}

#endif
