// A point of one eye as an estimate from both eyes looks at it (Shi, Billeter, Eisemann 2022, section 3.1).
// -D ESTIMATE_MONO: no point is seen by the other eye
#ifndef GLOAM_STEREO_ESTIMATE_H
#define GLOAM_STEREO_ESTIMATE_H

#include "shared/ambient_occlusion.h"
#include "shared/neighbour.h"

// The point as the other eye shows it, of use where that sees it.
static inline Receiver receiver_there(Frame frame, Neighbour neighbour, scalar radius, scalar max_reach, Receiver here,
                                      mask* is_seen) {
  const mask is_surface = !here.point.background;
  const Projection seen = project_into(
      neighbour, position_at(frame, here.point.x, here.point.y, choose(is_surface, here.depth, (real)(1))), is_surface);
#if ESTIMATE_MONO
  *is_seen = (mask)(0);
#else
  *is_seen = seen.is_seen;
#endif
  // Lanes that the other eye does not see read what is there at the same place, and make nothing of it.
  return receiver_of(neighbour.frame, radius, max_reach, choose(*is_seen, seen.x, here.point.x),
                     choose(*is_seen, seen.y, here.point.y), choose(*is_seen, seen.depth, here.depth),
                     rotated(neighbour, here.normal));
}

#endif
