// Whether a point in space lies behind what the screen shows there (Mittring 2007).
#ifndef GLOAM_BALL_ESTIMATOR_H
#define GLOAM_BALL_ESTIMATOR_H

#include "shared/sampling/slice.h"

// Depths are compared as heights above the tangent plane of the pixel's surface, which fall evenly along a ray. A pixel that
// shows the plane itself thus has height 0, wherever in the pixel the point fell. A surface on the plane, to within rounding,
// occludes nothing.
typedef struct {
  real per_x, per_y;  // height per pixel to the right and down, at the pixel's depth
  real fall;          // height gained by one unit of relative depth along the pixel's own ray; negative
  real rounding;      // height error per unit of relative depth; `fall` is that much steeper
} Heights;

// The normal, turned towards the eye where it faces away or is unknown.
static inline real3 normal_towards_eye(Surface s, real3 n) { return choose3(dot3(n, s.to_eye) > 0, n, s.normal); }

// `axis`: unit normal towards the eye. `pixels`: distance of the samples on the screen.
static inline Heights heights_of(Anchor a, Surface s, real3 axis, real pixels) {
  Heights h;
  h.per_x = axis.x * a.across_x;
  h.per_y = -axis.y * a.across_y;
  // Rounding: 2^-24 for a depth, a few times that for a ray, and 2^-23 over their distance for a normal that was made from
  // the depths of neighbouring pixels.
  h.rounding = (scalar)0x1p-20 * s.length + (scalar)0x1p-23 * pixels;
  h.fall = -dot3(axis, s.to_eye) * s.length - h.rounding;
  return h;
}

// At an offset in pixels: the height at the pixel's depth, and the height gained per unit of relative depth.
static inline real height_there(Heights h, real dx, real dy) { return dx * h.per_x + dy * h.per_y; }
static inline real fall_there(Frame f, Heights h, real height) { return h.fall + f.perspective * height; }

// Whether a surface at relative depth e stands before a point on the same ray. `lower`: the height at the pixel's depth less
// the point's, with `rounding` added to the latter. A choice between two: exact arithmetic.
static inline mask stands_before(real e, real fall, real lower) {
  // A ray that does not fall towards the plane meets the lower point first.
  return (e * fall + lower) * fall < 0;
}

// 1 up to `range` radii before the pixel's point, 0 from twice that on: the foreground does not occlude what is far behind
// it. `per_range`: 1 / range, the range in units of the pixel's depth.
static inline real range_weight(real e, real per_range) {
  return smaller(larger(multiply_add(e, per_range, (real)(2)), (real)(0)), (real)(1));
}

// A range of 0 is a very short one.
static inline real per_range_of(scalar range, real radius) {
  return (scalar)1 / larger((scalar)range * radius, (real)(1e-18f));
}

#endif
