// Positions. They are relative to the pixel at hand and in units of its depth, so that nothing overflows, the unit of the
// scene does not matter, and a sample on the pixel itself is exactly zero.
#ifndef GLOAM_CAMERA_H
#define GLOAM_CAMERA_H

#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

// Larger depths, in depths of the pixel at hand, are set to this: background has a finite position.
#define FARTHEST ((scalar)1e16)

static inline mask is_background(real depth) { return isinf(depth); }

// The pixel at hand.
typedef struct {
  real x, y;                // column and row
  real inverse_depth;       // 1 / z; 1 on background
  real lateral;             // depths by which a distance on the screen grows: 1 (perspective) or 1 / z
  real across_x, across_y;  // distance between neighbouring pixels at its depth, in units of its depth
  real ray_x, ray_y;        // sideways move along the pixel's ray per unit of depth; 0 if orthographic
  mask background;
} Anchor;

static inline Anchor anchor_at(Frame f, real x, real y, real depth) {
  Anchor a;
  a.x = x;
  a.y = y;
  a.background = is_background(depth);
  a.inverse_depth = quotient((real)(1), choose(a.background, (real)(1), depth));
  a.lateral = f.perspective + f.parallel * a.inverse_depth;
  a.across_x = f.scale_x * a.lateral;
  a.across_y = f.scale_y * a.lateral;
  a.ray_x = (x + (scalar)0.5 - f.centre_x) * (f.scale_x * f.perspective);
  a.ray_y = (f.centre_y - y - (scalar)0.5) * (f.scale_y * f.perspective);
  return a;
}

// (depth - own) / own, for `towards`. `own`: the depth that the anchor was made with.
static inline real relative_depth(Anchor a, real own, real depth) {
  return smaller((depth - own) * a.inverse_depth, (real)(FARTHEST));
}

// The same, infinite for background. What is made from it, infinities and NaN, must count nowhere: a comparison must say so.
static inline real any_relative_depth(Anchor a, real own, real depth) { return (depth - own) * a.inverse_depth; }

// From the anchor's point to the point seen dx pixels to the right and dy pixels down at relative depth e, in units of the
// anchor's depth. View space: y up, camera looks along -z.
static inline real3 towards_near(Frame f, Anchor a, real dx, real dy, real e) {
  const real ray_x = multiply_add(dx, (real)(f.scale_x * f.perspective), a.ray_x);
  const real ray_y = multiply_add(dy, (real)(-f.scale_y * f.perspective), a.ray_y);
  return make3(multiply_add(e, ray_x, dx * a.across_x), multiply_add(e, ray_y, dy * -a.across_y), -e);
}

// As towards_near, for the point seen at pixel (x, y).
static inline real3 towards(Frame f, Anchor a, real x, real y, real e) {
  return towards_near(f, a, x - a.x, y - a.y, e);
}

// As towards, with the same bits in every mode: for what decides which pixel is read.
static inline real3 exactly_towards(Frame f, Anchor a, real x, real y, real e) {
  const real dx = x - a.x, dy = y - a.y;
  const real ray_x = dx * (f.scale_x * f.perspective) + a.ray_x, ray_y = dy * (-f.scale_y * f.perspective) + a.ray_y;
  return make3(e * ray_x + dx * a.across_x, e * ray_y + dy * -a.across_y, -e);
}

// Direction from the eye through a pixel, not normalised.
static inline real3 view_ray(Frame f, real x, real y) {
  return make3((x + (scalar)0.5 - f.centre_x) * f.scale_x * f.perspective,
               (f.centre_y - y - (scalar)0.5) * f.scale_y * f.perspective, (real)(-1));
}

#endif
