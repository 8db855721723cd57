// What two eyes see of the same scene (Shi, Billeter, Eisemann 2022, sections 3.1 and 3.2): which pixels both of them see, and
// what one eye's result is worth to the other.
#ifndef GLOAM_STEREO_H
#define GLOAM_STEREO_H

#include "shared/frame/neighbour.h"

// A depth in whose sign is written that both eyes see the surface: negative where they do.
static inline real stereo_depth_of(real depth, mask is_shared) { return choose(is_shared, -depth, depth); }
static inline mask is_shared(real stereo_depth) { return stereo_depth < 0; }

// The other eye's pixel nearest to where it shows a point, as an index from the plane's start.
static inline integer nearest_index(Frame other, Projection there) {
  return nearest(there.y) * other.pitch + nearest(there.x) + FRAME_GUARD;
}

// What the other eye sees there, at `stereo_depth` or a depth, as a point of this eye's space; `is_known`: a surface.
static inline real3 seen_there(Neighbour n, Projection there, real other_depth, mask* is_known) {
  const real depth = fabs(other_depth);
  *is_known = there.is_seen & !is_background(depth);
  const real3 q =
      position_at(n.frame, to_real(nearest(there.x)), to_real(nearest(there.y)), choose(*is_known, depth, (real)(1)));
  return back_from_other(n, q);
}

// Squared distance in pixels from (x, y) to where this eye shows a point; not a number behind it.
static inline real squared_distance_on_screen(Frame f, real3 p, real x, real y) {
  const real lateral = (real)(1) / (f.parallel - f.perspective * p.z);
  const real dx = p.x * lateral * ((scalar)1 / f.scale_x) + f.centre_x - (scalar)0.5 - x;
  const real dy = f.centre_y - (scalar)0.5 - p.y * lateral * ((scalar)1 / f.scale_y) - y;
  return choose(p.z < 0, dx * dx + dy * dy, REAL_INFINITY);
}

// Whether both eyes see the surface at depth z of each pixel of the row: projected to the other eye, and what that sees at its
// nearest pixel back again, it comes to lie within `back_check` pixels.
static inline mask seen_by_both_eyes(Frame frame, Neighbour neighbour, scalar back_check, real z, PLANE other_depth) {
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const Projection there = project_row(frame, neighbour, z);
  mask is_known;
  const real3 p = seen_there(neighbour, there, gather(other_depth, nearest_index(neighbour.frame, there)), &is_known);
  return is_known & (squared_distance_on_screen(frame, p, x, y) <= back_check * back_check);
}

#endif
