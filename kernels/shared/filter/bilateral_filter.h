// Cross-bilateral filter (Petschnigg et al. 2004, Eisemann and Durand 2004): bilateral.h.
//
// in : source  to be filtered      depth  view-space z, scene units, +inf = background      normal  unit, view space
// out: result  filtered; FILTER_OUTSIDE on background and where it is not wanted
// -D COLUMNS, ROWS, COMPONENTS, MASKED (wanted.h). A file that defines FILTER_DISTANCE, FILTER_ANGLE and FILTER_OUTSIDE sets them for itself.
#ifndef GLOAM_BILATERAL_FILTER_H
#define GLOAM_BILATERAL_FILTER_H

#include "shared/filter/bilateral.h"
#include "shared/lanes/wanted.h"

// Tolerances in scene units and radians; what background gets.
#ifndef FILTER_DISTANCE
#define FILTER_DISTANCE (params.depth_tolerance * params.radius)
#define FILTER_ANGLE params.normal_tolerance
#define FILTER_OUTSIDE NO_RESULT
#endif

static inline Taps filtered_taps(Frame frame, Params params, Sources sources, PLANE depth, PLANE normal_x,
                                 PLANE normal_y, PLANE normal_z) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  const TangentPlane plane = tangent_plane_at(frame, to_real(x), (real)(y), load(depth, here),
                                              load3(normal_x, normal_y, normal_z, here), FILTER_DISTANCE, FILTER_ANGLE);
  return taps_around(frame, plane, x, y, here, sources, depth, normal_x, normal_y, normal_z);
}

// in : source, depth, normal; wanted
// out: result
kernel void bilateral(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Sources sources = SOURCE_PLANES(source);
  const Results results = RESULT_PLANES(result);
  SKIP_UNWANTED(frame, store_all(FILTER_OUTSIDE, results, here))
  const Taps taps = filtered_taps(frame, params, sources, depth, normal_x, normal_y, normal_z);
  const mask counts = !is_background(load(depth, here)) & is_wanted;
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c)
    store(choose(counts, mean_of(taps.sums[c], taps.weights), FILTER_OUTSIDE), results.planes[c], here);
}

#endif
