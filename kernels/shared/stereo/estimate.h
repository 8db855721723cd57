// A point of one eye as an estimate from both eyes looks at it (Shi, Billeter, Eisemann 2022, section 3.1).
// -D ESTIMATE_MONO: no point is seen by the other eye; WITH_HALF_OCCLUSION: only those where the eyes may differ
#ifndef GLOAM_STEREO_ESTIMATE_H
#define GLOAM_STEREO_ESTIMATE_H

#include "shared/lanes/pixel_list.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/stereo/half_occlusion.h"

static inline real3 position_of(Frame f, Receiver r) {
  return position_at(f, r.point.x, r.point.y, choose(r.point.background, (real)(1), r.depth));
}

// One pixel for each lane, by its index from the plane's start; `depth`: with the sign of visibility.h.
static inline Receiver receiver_at_index(Frame frame, scalar radius, scalar max_reach, integer index, PLANE depth,
                                         PLANE normal_x, PLANE normal_y, PLANE normal_z) {
  const integer x = column_of(frame, index), y = row_of(frame, index);
  Receiver r = receiver_of(frame, radius, max_reach, to_real(x), to_real(y), fabs(gather(depth, index)),
                           gather3(normal_x, normal_y, normal_z, index));
  r.noise = noise_of(to_natural(x), to_natural(y), frame.seed);
  return r;
}

// The mask of lanes for which the other eye is worth a look (half_occlusion.h). A kernel has the argument
// HALF_OCCLUDED_ARGUMENT after the other eye's planes.
#if WITH_HALF_OCCLUSION
#define HALF_OCCLUDED_ARGUMENT PLANE other_half_occluded,
#define MAY_DIFFER(frame, neighbour, radius, receiver)                                                         \
  (is_near_marked(other_half_occluded, (neighbour).frame, into_other(neighbour, position_of(frame, receiver)), \
                  radius) |                                                                                    \
   reaches_out_of_either(frame, neighbour, receiver))

static inline mask reaches_out(Frame f, real x, real y, Reach reach) {
  const real right = (scalar)(f.width - 1) - x, bottom = (scalar)(f.height - 1) - y;
  // Asked so that what cannot be compared reaches out.
  return !((smaller(x, right) >= reach.pixels_x) & (smaller(y, bottom) >= reach.pixels_y));
}

// Whether what lies around a point is cut off by the border of one image, which is not that of the other: what the two eyes find
// there differs though nothing is half-occluded.
static inline mask reaches_out_of_either(Frame frame, Neighbour neighbour, Receiver r) {
  const Projection there = project_into(neighbour, position_of(frame, r), !r.point.background);
  return !r.point.background & (reaches_out(frame, r.point.x, r.point.y, r.reach) |
                                (there.is_seen & reaches_out(neighbour.frame, there.x, there.y, r.reach)));
}
#else
#define HALF_OCCLUDED_ARGUMENT
#define MAY_DIFFER(frame, neighbour, radius, receiver) EVERY_LANE
#endif

// The point as the other eye shows it, of use where that sees it and is looked at: where it `may_differ`.
static inline Receiver receiver_there(Frame frame, Neighbour neighbour, scalar radius, scalar max_reach, Receiver here,
                                      mask may_differ, mask* is_seen) {
#if ESTIMATE_MONO
  may_differ = (mask)(0);
#endif
  const Projection seen = project_into(neighbour, position_of(frame, here), (!here.point.background) & may_differ);
  *is_seen = seen.is_seen;
  // Lanes that the other eye does not see read what is there at the same place, and make nothing of it.
  return receiver_of(neighbour.frame, radius, max_reach, choose(*is_seen, seen.x, here.point.x),
                     choose(*is_seen, seen.y, here.point.y), choose(*is_seen, seen.depth, here.depth),
                     rotated(neighbour, here.normal));
}

#endif
