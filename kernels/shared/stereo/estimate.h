// A point of one eye as seen by both, for estimates from two eyes (Shi, Billeter, Eisemann 2022, section 3.1).
// -D ESTIMATE_MONO: the other eye is never used; WITH_HALF_OCCLUSION: it is used only where the eyes may differ
#ifndef GLOAM_STEREO_ESTIMATE_H
#define GLOAM_STEREO_ESTIMATE_H

#include "shared/sampling/ambient_occlusion.h"
#include "shared/stereo/half_occlusion.h"

static inline real3 position_of(Frame f, Receiver r) {
  return position_at(f, r.point.x, r.point.y, choose(r.point.background, (real)(1), r.depth));
}

// MAY_DIFFER: lanes for which the other eye is used (half_occlusion.h).
#if WITH_HALF_OCCLUSION
#define MAY_DIFFER(frame, neighbour, radius, receiver)                                                         \
  (is_near_marked(other_half_occluded, (neighbour).frame, into_other(neighbour, position_of(frame, receiver)), \
                  radius) |                                                                                    \
   reaches_out_of_either(frame, neighbour, receiver))

static inline mask reaches_out(Frame f, real x, real y, Reach reach) {
  const real right = (scalar)(f.width - 1) - x, bottom = (scalar)(f.height - 1) - y;
  // Negated, so that NaN reaches out.
  return !((smaller(x, right) >= reach.pixels_x) & (smaller(y, bottom) >= reach.pixels_y));
}

// Whether the border of either image cuts off the surroundings of a point: the eyes then find different occluders though nothing
// is half-occluded.
static inline mask reaches_out_of_either(Frame frame, Neighbour neighbour, Receiver r) {
  const Projection there = project_into(neighbour, position_of(frame, r), !r.point.background);
  return !r.point.background & (reaches_out(frame, r.point.x, r.point.y, r.reach) |
                                (there.is_seen & reaches_out(neighbour.frame, there.x, there.y, r.reach)));
}
#else
#define MAY_DIFFER(frame, neighbour, radius, receiver) EVERY_LANE
#endif

// The point as the other eye shows it, valid where `is_seen`. The other eye is used only where the point `may_differ`.
static inline Receiver receiver_there(Frame frame, Neighbour neighbour, scalar radius, scalar max_reach, Receiver here,
                                      mask may_differ, mask* is_seen) {
#if ESTIMATE_MONO
  may_differ = (mask)(0);
#endif
  const Projection seen = project_into(neighbour, position_of(frame, here), (!here.point.background) & may_differ);
  *is_seen = seen.is_seen;
  // Lanes that the other eye does not see read the same pixel there, and ignore it.
  return receiver_of(neighbour.frame, radius, max_reach, choose(*is_seen, seen.x, here.point.x),
                     choose(*is_seen, seen.y, here.point.y), choose(*is_seen, seen.depth, here.depth),
                     rotated(neighbour, here.normal));
}

#endif
