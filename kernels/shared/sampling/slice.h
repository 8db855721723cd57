// Half planes through the pixel's ray, by which GTAO divides the hemisphere (Jimenez, Wu, Pesce, Jarabo 2016, section 4): what
// the screen shows along a line through the pixel lies in one slice. Angles in a slice are elevations above the surface's
// tangent, so that a plane is flat to the last bit, and are measured by the cosine-weighted mass below them.
#ifndef GLOAM_SLICE_H
#define GLOAM_SLICE_H

#include "shared/frame/camera.h"
#include "shared/lanes/math.h"

#define HALF_PI ((scalar)1.5707963267948966)

// The pixel's surface, the same for all slices.
typedef struct {
  real3 to_eye, normal;  // to_eye: unit; normal: turned towards the eye where it faces away
  real facing;           // normal . to_eye
  real away;             // normal . ray; negative. The ray is one unit of depth long
  real length;           // of that ray
  real level;            // length of that ray without its y component
} Surface;

// The least normal . to_eye: a normal nearer to the horizon or turned away is turned towards the eye up to here.
#define LEAST_FACING ((scalar)1e-4f)

static inline Surface surface_at(Anchor a, real3 n) {
  Surface s;
  // Exact in every mode, since it decides where samples lie.
  const real level_square = 1 + a.ray_x * a.ray_x;
  s.level = sqrt(level_square);
  s.length = sqrt(level_square + a.ray_y * a.ray_y);
  const real inverse = quick_inverse(s.length);
  s.to_eye = make3(-a.ray_x * inverse, -a.ray_y * inverse, inverse);
  const real short_of = larger(LEAST_FACING - dot3(n, s.to_eye), (real)(0));
  s.normal = make3(n.x + short_of * s.to_eye.x, n.y + short_of * s.to_eye.y, n.z + short_of * s.to_eye.z);
  s.facing = dot3(s.normal, s.to_eye);
  s.away = -s.facing * s.length;
  return s;
}

// One slice. A point seen dx pixels to the right and dy below, at relative depth e (camera.h), lies at
//   above = q * (dx * above_x + dy * above_y) + e * above_e
//   along = q * (dx * along_x + dy * along_y) - slope * above
// above the surface's tangent and along it, in units of the pixel's depth. q: the point's depth in those units (perspective), or
// 1 (orthographic).
typedef struct {
  real screen_x, screen_y;  // direction on the screen, times across_x and across_y: pixels per unit
  real along_x, along_y, above_x, above_y, above_e, slope;
  real cosine, sine;  // of the angle from the line to the eye to the normal's projection, -pi/2 to pi/2
  real3 tangent;      // unit, at right angles to the line to the eye, to the right side
  real mass;          // cosine-weighted mass of the slice's directions, if the normal lay in it
  real weight;        // cosine-weighted mass as it is
} Slice;

// asin(c) + c sqrt(1 - c^2) for -1 to 1: odd, absolute error below 1.5e-3, exact at 0 and 1.
static inline real arc_mass(real c) {
  const real cc = c * c;
  real p = multiply_add(cc, (real)(-0.21154354f), (real)(0.21089456f));
  p = multiply_add(cc, p, (real)(-0.4395381f));
  return c * multiply_add(cc, p, (real)(2.01098341f));
}

// Twice the cosine-weighted mass from the tangent up to the elevation with the cosine c and the squared sine `square`, on
// the side to which the normal leans by (cosine, sine): the integral of 2 sin(a) cos(lean - a) over a.
static inline real mass_below(real c, real square, real cosine, real sine) {
  return multiply_add(sine, HALF_PI - arc_mass(c), cosine * square);
}

// Share of a slice's mass on the side to which the normal leans by (cosine, sine).
static inline real share_of_side(real cosine, real sine, real mass) {
  return mass_below(-sine, cosine * cosine, cosine, sine) * ((scalar)0.5 * quick_inverse(mass));
}

// The y component of a slice's tangent, which decides where it samples.
static inline real tangent_y_of(Anchor a, Surface s, real inverse_level, real cosine, real sine) {
  return (cosine * a.ray_x * a.ray_y + sine * s.length) * inverse_level;
}

// `cosine`, `sine`: of the slice's angle about the line to the eye.
static inline Slice slice_at(Anchor a, Surface s, real cosine, real sine) {
  MAY_FUSE
  Slice c;
  const real inverse_level = quotient((real)(1), s.level);
  // The slice's tangent at right angles to the line to the eye, moved along that line into the plane of the pixel's depth: the
  // image's x and y axes turned about the line to the eye, written out.
  const real x = cosine * s.level;
  const real y = tangent_y_of(a, s, inverse_level, cosine, sine);
  c.screen_x = x;
  c.screen_y = -y;
  // The distance that it was moved.
  const real slide = (cosine * a.ray_x * s.length + sine * a.ray_y) * inverse_level;
  c.tangent = make3(x + slide * s.to_eye.x, y + slide * s.to_eye.y, slide * s.to_eye.z);
  const real across = s.normal.x * x + s.normal.y * y + slide * s.facing;  // normal . tangent
  const real inverse_length = inverse_sqrt(s.facing * s.facing + across * across);
  c.sine = across * inverse_length;
  c.cosine = s.facing * inverse_length;
  const real inverse_facing = quick_inverse(s.facing);
  c.slope = across * inverse_facing;
  // Projected onto the slice's line on the screen, and by 1 / cosine onto the surface's tangent.
  const real along = quick_inverse((x * x + y * y) * c.cosine);
  c.along_x = a.across_x * x * along;
  c.along_y = -a.across_y * y * along;
  c.above_x = s.normal.x * a.across_x * inverse_length;
  c.above_y = -s.normal.y * a.across_y * inverse_length;
  c.above_e = s.away * inverse_length;
  c.mass = c.cosine * c.cosine * c.cosine + c.sine * arc_mass(c.sine);
  c.weight = c.mass * (s.facing * s.facing + across * across) * inverse_length;
  return c;
}

#endif
