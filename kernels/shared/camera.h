// Positions. Everything is relative to the pixel at hand and in units of its depth, so that nothing overflows, nothing
// depends on the unit of the scene, and a sample on the pixel itself is exactly zero.
#ifndef GLOAM_CAMERA_H
#define GLOAM_CAMERA_H

#include "shared/load.h"

// Depths further away than this, in depths of the pixel at hand, count as this: background has a finite position.
#define FARTHEST ((scalar)1e16)

static inline mask is_background(real depth) { return isinf(depth); }

// The pixel at hand.
typedef struct {
  real x, y;                // column and row
  real inverse_depth;       // 1 / z; 1 on background
  real across_x, across_y;  // distance between neighbouring pixels at its depth, in units of its depth
  mask background;
} Anchor;

static inline Anchor anchor_at(Frame f, real x, real y, real depth) {
  Anchor a;
  a.x = x;
  a.y = y;
  a.background = is_background(depth);
  a.inverse_depth = (scalar)1 / choose(a.background, (real)(1), depth);
  const real lateral = f.perspective + f.parallel * a.inverse_depth;
  a.across_x = f.scale_x * lateral;
  a.across_y = f.scale_y * lateral;
  return a;
}

// (depth - own depth) / own depth, for `towards`. `own` is the depth that the anchor was made with.
static inline real relative_depth(Anchor a, real own, real depth) {
  return min((depth - own) * a.inverse_depth, (real)(FARTHEST));
}

// From the anchor's point to the point seen at pixel (x, y), whose relative depth is e; in units of the anchor's depth.
// View space: y up, camera looks along -z.
static inline real3 towards(Frame f, Anchor a, real x, real y, real e) {
  const real spread = e * f.perspective;
  return make3((x - a.x) * a.across_x + (x + (scalar)0.5 - f.centre_x) * f.scale_x * spread,
               (a.y - y) * a.across_y + (f.centre_y - y - (scalar)0.5) * f.scale_y * spread, -e);
}

// Direction from the eye through a pixel, not normalised.
static inline real3 view_ray(Frame f, real x, real y) {
  return make3((x + (scalar)0.5 - f.centre_x) * f.scale_x * f.perspective,
               (f.centre_y - y - (scalar)0.5) * f.scale_y * f.perspective, (real)(-1));
}

#endif
