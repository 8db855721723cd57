// Importance sampling of slices: their angles in proportion to their weight (slice.h). With one slice a pixel, the mean over pixels
// or seeds is then the integral over all slices.
#ifndef GLOAM_SLICE_ANGLE_H
#define GLOAM_SLICE_ANGLE_H

#include "shared/sampling/slice.h"

// Turns an angle that is evenly spread over half a turn, so that its density follows the weight of its slice. Returns the
// derivative, turned angle by even angle: the slice's share of half a turn. weight * derivative, which a slice counts, is 1 on
// average: .98 to 1.01 up to a tilt of 37 degrees from the line to the eye, .56 to 1.13 at 72 degrees, .16 to 1.17 at 85.
//
// With s the sine of the tilt, c its cosine, and a the angle from the normal's own slice, the weight and its integral are
//   w(a) = c + s cos(a) atan(s cos(a) / c),   W(a) = atan(c tan(a)) + s sin(a) atan(s cos(a) / c),
// with a mean of 1 over half a turn. The inverse of W has no closed form: a - sin(2a) (p + q cos(2a) + r cos^2(2a)) is fitted to
// it, with p, q and r polynomials in s^2. The fit need not be exact: the returned derivative is the fit's own.
static inline real turn_by_weight(Anchor a, Surface s, real* cosine, real* sine) {
  const real inverse_level = quotient((real)(1), s.level);
  // normal . tangent, as slice_at has it, of the slices at 0 and at a quarter turn.
  const real across_at_zero =
      s.normal.x * s.level + (a.ray_x * a.ray_y * s.normal.y + a.ray_x * s.length * s.facing) * inverse_level;
  const real across_at_quarter = (s.normal.y * s.length + a.ray_y * s.facing) * inverse_level;
  // Beside the image, where work-items may lie, normals are of any length.
  const real all = across_at_zero * across_at_zero + across_at_quarter * across_at_quarter, square = smaller(all, (real)(1));
  const real inverse = quotient((real)(1), sqrt(all + (scalar)1e-20f));
  // Of the angle from the normal's own slice. Where the normal points to the eye, `square` is 0 and nothing is turned.
  const real from_cosine = (*cosine * across_at_zero + *sine * across_at_quarter) * inverse;
  const real from_sine = (*sine * across_at_zero - *cosine * across_at_quarter) * inverse;
  const real twice_sine = 2 * from_sine * from_cosine, twice_cosine = 1 - 2 * from_sine * from_sine;
  const real p = square * ((scalar)0.224f + square * ((scalar)0.17208f - (scalar)0.17788f * square));
  const real q = square * ((scalar)0.06328f - square * ((scalar)0.44239f - (scalar)0.25163f * square));
  const real r = square * ((scalar)-0.08113f + square * ((scalar)0.35633f - (scalar)0.1916f * square));
  const real shape = p + twice_cosine * (q + twice_cosine * r);
  // At most .27: the polynomials of sine and cosine are exact to float's rounding.
  const real turn = -twice_sine * shape, t = turn * turn;
  const real turn_sine = turn * (1 - t * ((scalar)(1.0 / 6) - t * (scalar)(1.0 / 120)));
  const real turn_cosine = 1 - t * ((scalar)0.5 - t * ((scalar)(1.0 / 24) - t * (scalar)(1.0 / 720)));
  const real turned = *cosine * turn_cosine - *sine * turn_sine;
  *sine = *sine * turn_cosine + *cosine * turn_sine;
  *cosine = turned;
  return 1 - 2 * (twice_cosine * shape - twice_sine * twice_sine * (q + 2 * twice_cosine * r));
}

#endif
