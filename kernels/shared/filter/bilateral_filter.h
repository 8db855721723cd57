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
#if COMPONENTS == 1
#define FILTER_OUTSIDE ((real)(1))
#else
#define FILTER_OUTSIDE ((real)(0))
#endif
#endif

static inline Taps filtered_taps(Frame frame, Params params, Sources sources, PLANE depth, PLANE normal_x,
                                 PLANE normal_y, PLANE normal_z) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  const TangentPlane plane = tangent_plane_at(frame, to_real(x), (real)(y), load(depth, here),
                                              load3(normal_x, normal_y, normal_z, here), FILTER_DISTANCE, FILTER_ANGLE);
  return taps_around(frame, plane, x, y, here, sources, depth, normal_x, normal_y, normal_z);
}

// Divided exactly, so that an open neighbourhood stays exactly open.
static inline void store_mean(Taps taps, int component, mask counts, PLANE_OUT result, int here) {
  store(choose(counts, taps.sums[component] / taps.weights, FILTER_OUTSIDE), result, here);
}

#if COMPONENTS == 1
kernel void bilateral(Frame frame, Params params, PLANE source, PLANE depth, PLANE normal_x, PLANE normal_y,
                      PLANE normal_z, WANTED_ARGUMENT PLANE_OUT result) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  SKIP_UNWANTED(frame, store(FILTER_OUTSIDE, result, here))
  const Taps taps = filtered_taps(frame, params, one_source(source), depth, normal_x, normal_y, normal_z);
  store_mean(taps, 0, !is_background(load(depth, here)) & is_wanted, result, here);
}
#elif COMPONENTS == 3
kernel void bilateral_color(Frame frame, Params params, PLANE source_r, PLANE source_g, PLANE source_b, PLANE depth,
                            PLANE normal_x, PLANE normal_y, PLANE normal_z, WANTED_ARGUMENT PLANE_OUT result_r,
                            PLANE_OUT result_g, PLANE_OUT result_b) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  SKIP_UNWANTED(frame, store(FILTER_OUTSIDE, result_r, here); store(FILTER_OUTSIDE, result_g, here);
                store(FILTER_OUTSIDE, result_b, here))
  const Sources sources = {{source_r, source_g, source_b}};
  const Taps taps = filtered_taps(frame, params, sources, depth, normal_x, normal_y, normal_z);
  const mask counts = !is_background(load(depth, here)) & is_wanted;
  store_mean(taps, 0, counts, result_r, here);
  store_mean(taps, 1, counts, result_g, here);
  store_mean(taps, 2, counts, result_b, here);
}
#endif

#endif
