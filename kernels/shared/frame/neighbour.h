// A pixel's point as the other of two views sees it, or as this view saw it in the frame before (frame.h).
#ifndef GLOAM_NEIGHBOUR_H
#define GLOAM_NEIGHBOUR_H

#include "shared/frame/camera.h"
#include "shared/sampling/sample.h"

static inline real3 rotated(Neighbour n, real3 v) {
  return make3(n.rotation[0] * v.x + n.rotation[1] * v.y + n.rotation[2] * v.z,
               n.rotation[3] * v.x + n.rotation[4] * v.y + n.rotation[5] * v.z,
               n.rotation[6] * v.x + n.rotation[7] * v.y + n.rotation[8] * v.z);
}

// The point that pixel (x, y) shows at this depth: view space, scene units.
static inline real3 position_at(Frame f, real x, real y, real depth) {
  const real lateral = f.perspective * depth + f.parallel;
  return make3((x + (scalar)0.5 - f.centre_x) * f.scale_x * lateral,
               (f.centre_y - y - (scalar)0.5) * f.scale_y * lateral, -depth);
}

// A point of this view's space in the other's, and back.
static inline real3 into_other(Neighbour n, real3 p) {
  const real3 r = rotated(n, p);
  return make3(r.x + n.translation[0], r.y + n.translation[1], r.z + n.translation[2]);
}

static inline real3 rotated_back(Neighbour n, real3 v) {
  return make3(n.rotation[0] * v.x + n.rotation[3] * v.y + n.rotation[6] * v.z,
               n.rotation[1] * v.x + n.rotation[4] * v.y + n.rotation[7] * v.z,
               n.rotation[2] * v.x + n.rotation[5] * v.y + n.rotation[8] * v.z);
}

static inline real3 back_from_other(Neighbour n, real3 q) {
  return rotated_back(n, make3(q.x - n.translation[0], q.y - n.translation[1], q.z - n.translation[2]));
}

// Where a view shows a point of its space: column and row, not rounded, and the depth. `is_seen`: the point lies before the eye and
// within the image, hidden or not. Where it does not, the numbers can be used safely but mean nothing.
typedef struct {
  real x, y, depth;
  mask is_seen;
} Projection;

static inline Projection project_onto(Frame f, real3 q, mask is_there) {
  Projection s;
  s.is_seen = is_there & (q.z < 0);
  s.depth = choose(s.is_seen, -q.z, (real)(1));
  const real lateral = f.perspective * s.depth + f.parallel;
  s.x = q.x / (f.scale_x * lateral) + f.centre_x - (scalar)0.5;
  s.y = f.centre_y - (scalar)0.5 - q.y / (f.scale_y * lateral);
  const scalar right = (scalar)f.width - (scalar)0.5, bottom = (scalar)f.height - (scalar)0.5;
  s.is_seen &= (s.x >= (scalar)-0.5) & (s.x < right) & (s.y >= (scalar)-0.5) & (s.y < bottom);
  s.x = choose(s.is_seen, s.x, (real)(0));
  s.y = choose(s.is_seen, s.y, (real)(0));
  return s;
}

static inline Projection project_into(Neighbour n, real3 p, mask is_there) {
  return project_onto(n.frame, into_other(n, p), is_there);
}

// Projects what the work-item's row of pixels shows at depth z.
static inline Projection project_row(Frame f, Neighbour n, real z) {
  const mask is_surface = !is_background(z);
  return project_into(n, position_at(f, to_real(FIRST_X + IOTA), (real)(ROW_Y), choose(is_surface, z, (real)(1))),
                      is_surface);
}

// A point that need not lie on a pixel centre, and the pixel nearest to it.
typedef struct {
  integer column, row, index;
  real left, up;  // from the point to the pixel
} Centre;

static inline Centre centre_of(Frame f, Anchor point) {
  Centre c;
  c.column = nearest(point.x);
  c.row = nearest(point.y);
  c.index = FRAME_GUARD + c.row * f.pitch + c.column;
  c.left = to_real(c.column) - point.x;
  c.up = to_real(c.row) - point.y;
  return c;
}

// Index from the plane's start of the pixel (dx, dy) from a centre. `within`: SAMPLES_INSIDE or SAMPLES_CLAMPED; the latter moves
// pixels outside the image onto its border and clears `is_inside`. Pixels inside get the same bits with both, so that no lane
// depends on another.
static inline __attribute__((always_inline)) integer place_around(Frame f, Centre c, int within, integer* dx,
                                                                  integer* dy, mask* is_inside) {
  *is_inside = EVERY_LANE;
  if (within == SAMPLES_INSIDE) return c.index + index_near_short(f, *dx - IOTA, *dy);
  const integer x = clamp(c.column + *dx, (integer)(0), (integer)(f.width - 1));
  const integer y = clamp(c.row + *dy, (integer)(0), (integer)(f.height - 1));
  *is_inside = to_mask((x == c.column + *dx) & (y == c.row + *dy));
  *dx = x - c.column;
  *dy = y - c.row;
  return FRAME_GUARD + y * f.pitch + x;
}

#endif
