// Cross-bilateral filter (Petschnigg et al. 2004, Eisemann and Durand 2004): bilateral.h.
//
// in : source  to be filtered      depth  view-space z, scene units, +inf = background      normal  unit, view space
// out: result  filtered; FILTER_OUTSIDE on background and where it is not wanted
// -D COLUMNS, ROWS, COMPONENTS, MASKED (wanted.h), SEPARABLE (along rows, then along columns), ROWS_OF_ITEM (then: rows per
// work-item, 1 to 32). A file that defines FILTER_DISTANCE, FILTER_ANGLE and FILTER_OUTSIDE sets them for itself.
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

static inline TangentPlane filter_plane(Frame frame, Params params, int y, int here, PLANE depth, PLANE normal_x,
                                        PLANE normal_y, PLANE normal_z) {
  return tangent_plane_at(frame, to_real(FIRST_X + IOTA), (real)(y), load(depth, here),
                          load3(normal_x, normal_y, normal_z, here), FILTER_DISTANCE, FILTER_ANGLE);
}

static inline void means_of(Taps taps, mask counts, real otherwise, real* means) {
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) means[c] = choose(counts, mean_of(taps.sums[c], taps.weights), otherwise);
}

static inline void store_means(const real* means, Results results, int here) {
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) store(means[c], results.planes[c], here);
}

#if !SEPARABLE
// in : source, depth, normal; wanted
// out: result
kernel void bilateral(ARGUMENTS) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const Sources sources = SOURCE_PLANES(source);
  const Results results = RESULT_PLANES(result);
  SKIP_UNWANTED(frame, store_all(FILTER_OUTSIDE, results, here))
  const TangentPlane plane = filter_plane(frame, params, y, here, depth, normal_x, normal_y, normal_z);
  Taps taps;
  sum_taps_around(&taps, frame, plane, FIRST_X + IOTA, y, here, COLUMNS, ROWS, sources, depth, normal_x, normal_y, normal_z);
  real means[COMPONENTS];
  means_of(taps, !is_background(load(depth, here)) & is_wanted, FILTER_OUTSIDE, means);
  store_means(means, results, here);
}
#else
// So many rows further down the planes are told to a CPU: going down a column, it does not see by itself what comes next.
#define ROWS_AHEAD 4

// Whether row y is among the taps of one of `rows` (WANTED_ROWS from `first` on).
static inline int is_tap_of(uint rows, int y, int first) {
  return (((ulong)rows << (2 * ROWS)) >> (y - first + ROWS) & ((1ul << (2 * ROWS + 1)) - 1)) != 0;
}

// The filter along the rows and then along the columns. A work-item goes down, and keeps the last 2 ROWS + 1 rows filtered along the row:
// every plane comes from memory once.
//
// in : source, depth, normal; wanted
// out: result
kernel void bilateral_separable(ARGUMENTS) {
  const Sources sources = SOURCE_PLANES(source);
  const Results results = RESULT_PLANES(result);
  const int first = ROW_Y * ROWS_OF_ITEM, end = min(first + ROWS_OF_ITEM, frame.height);
  const uint rows = WANTED_ROWS(frame, first, end);
  real along_rows[(2 * ROWS + 1) * COMPONENTS];
#pragma unroll
  for (int k = 0; k < (2 * ROWS + 1) * COMPONENTS; ++k) along_rows[k] = (real)(0);
  for (int last = max(first - ROWS, 0); last < end + ROWS; ++last) {
#pragma unroll
    for (int k = 0; k < 2 * ROWS * COMPONENTS; ++k) along_rows[k] = along_rows[k + COMPONENTS];
    if (last < frame.height && is_tap_of(rows, last, first)) {
      const int here = index_of(frame, FIRST_X, last);
      const int ahead = here + ROWS_AHEAD * frame.pitch + LANES;
      expect_surface(depth, normal_x, normal_y, normal_z, ahead);
#pragma unroll
      for (int c = 0; c < COMPONENTS; ++c) expect_load(sources.planes[c], ahead);
      const TangentPlane plane = filter_plane(frame, params, last, here, depth, normal_x, normal_y, normal_z);
      Taps taps;
      sum_taps_around(&taps, frame, plane, FIRST_X + IOTA, last, here, COLUMNS, 0, sources, depth, normal_x, normal_y,
                      normal_z);
      means_of(taps, !is_background(load(depth, here)), NO_RESULT, along_rows + 2 * ROWS * COMPONENTS);
    }
    const int y = last - ROWS, here = index_of(frame, FIRST_X, y);
    if (y < first) continue;
    const mask is_wanted = WANTED_PIXELS(frame, y);
    if (!ANY(is_wanted)) {
      OPEN_UNLESS_KEPT(store_all(FILTER_OUTSIDE, results, here))
      continue;
    }
    const TangentPlane plane = filter_plane(frame, params, y, here, depth, normal_x, normal_y, normal_z);
    Taps taps;
    sum_taps_along_column(&taps, frame, plane, y, here, ROWS, along_rows, depth, normal_x, normal_y, normal_z);
    real means[COMPONENTS];
    means_of(taps, !is_background(load(depth, here)) & is_wanted, FILTER_OUTSIDE, means);
    store_means(means, results, here);
  }
}
#endif

#endif
