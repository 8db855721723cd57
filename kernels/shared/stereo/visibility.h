// Which pixels both eyes see (Shi, Billeter, Eisemann 2022, sections 3.1 and 3.2), and where in the other eye.
#ifndef GLOAM_STEREO_H
#define GLOAM_STEREO_H

#include "shared/frame/neighbour.h"

// A depth whose sign tells whether both eyes see the surface: negative where they do.
static inline real stereo_depth_of(real depth, mask is_shared) { return choose(is_shared, -depth, depth); }
static inline mask is_shared(real stereo_depth) { return stereo_depth < 0; }

// Index, from the plane's start, of the other eye's pixel nearest to where it shows a point.
static inline integer nearest_index(Frame other, Projection there) {
  return nearest(there.y) * other.pitch + nearest(there.x) + FRAME_GUARD;
}

// The point that the other eye sees there, in this eye's space, from its depth or `stereo_depth`; `is_known`: it is a surface.
static inline real3 seen_there(Neighbour n, Projection there, real other_depth, mask* is_known) {
  const real depth = fabs(other_depth);
  *is_known = there.is_seen & !is_background(depth);
  const real3 q =
      position_at(n.frame, to_real(nearest(there.x)), to_real(nearest(there.y)), choose(*is_known, depth, (real)(1)));
  return back_from_other(n, q);
}

// Squared distance in pixels from (x, y) to where this eye shows a point; infinite for a point behind the eye.
static inline real squared_distance_on_screen(Frame f, real3 p, real x, real y) {
  const real lateral = (real)(1) / (f.parallel - f.perspective * p.z);
  const real dx = p.x * lateral * ((scalar)1 / f.scale_x) + f.centre_x - (scalar)0.5 - x;
  const real dy = f.centre_y - (scalar)0.5 - p.y * lateral * ((scalar)1 / f.scale_y) - y;
  return choose(p.z < 0, dx * dx + dy * dy, REAL_INFINITY);
}

// Whether both eyes see the surface at depth z of each pixel of the row: the pixel is projected to the other eye, and what that eye
// sees at its nearest pixel is projected back to within `back_check` pixels of the pixel.
static inline mask seen_by_both_eyes(Frame frame, Neighbour neighbour, scalar back_check, real z, PLANE other_depth) {
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const Projection there = project_row(frame, neighbour, z);
  mask is_known;
  const real3 p = seen_there(neighbour, there, gather(other_depth, nearest_index(neighbour.frame, there)), &is_known);
  return is_known & (squared_distance_on_screen(frame, p, x, y) <= back_check * back_check);
}

#endif
