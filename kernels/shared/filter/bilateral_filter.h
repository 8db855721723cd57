// Cross-bilateral filter (Petschnigg et al. 2004, Eisemann and Durand 2004): bilateral.h.
//
// in : source  to be filtered      depth  view-space z, scene units, +inf = background      normal  unit, view space
// out: result  filtered; FILTER_OUTSIDE on background and where it is not wanted
// -D COLUMNS, ROWS, MASKED (wanted.h). A file that defines FILTER_DISTANCE, FILTER_ANGLE and FILTER_OUTSIDE sets them for itself.
#ifndef GLOAM_BILATERAL_FILTER_H
#define GLOAM_BILATERAL_FILTER_H

#include "shared/filter/bilateral.h"
#include "shared/lanes/wanted.h"

// Tolerances in scene units and radians; what background gets.
#ifndef FILTER_DISTANCE
#define FILTER_DISTANCE (params.depth_tolerance * params.radius)
#define FILTER_ANGLE params.normal_tolerance
#define FILTER_OUTSIDE ((real)(1))
#endif

kernel void bilateral(Frame frame, Params params, PLANE source, PLANE depth, PLANE normal_x, PLANE normal_y,
                      PLANE normal_z, WANTED_ARGUMENT PLANE_OUT result) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  SKIP_UNWANTED(frame, store(FILTER_OUTSIDE, result, here))
  const integer x = FIRST_X + IOTA;
  const real z = load(depth, here);
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(x), (real)(y), z, load3(normal_x, normal_y, normal_z, here),
                       FILTER_DISTANCE, FILTER_ANGLE);
  const Taps taps = taps_around(frame, plane, x, y, here, source, depth, normal_x, normal_y, normal_z);
  // Divided exactly, so that an open neighbourhood stays exactly open.
  store(choose(is_background(z) | !is_wanted, FILTER_OUTSIDE, taps.sum / taps.weights), result, here);
}

#endif
