// Taps of a cross-bilateral filter, along one axis or over both at once. A tap counts by its distance on the screen, by its
// distance from the pixel's tangent plane and by the angle between the normals; each of the three weights ends at 0.
#ifndef GLOAM_BILATERAL_H
#define GLOAM_BILATERAL_H

#include "shared/frame/surface.h"
#include "shared/lanes/components.h"

// Biweight: 1 at the pixel, 0 one pixel beyond the last tap.
static inline scalar window_at(int k, int taps) {
  const scalar t = (scalar)k * ((scalar)1 / (taps + 1));
  return (1 - t * t) * (1 - t * t);
}

typedef struct {
  real sums[COMPONENTS], weights;
} Taps;

// The taps of a pixel alone, which has weight 1.
static inline Taps own_tap(const real* values) {
  Taps taps;
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) taps.sums[c] = values[c];
  taps.weights = (real)(1);
  return taps;
}

static inline void add_tap(Taps* taps, real weight, const real* values) {
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) taps->sums[c] = multiply_add(weight, values[c], taps->sums[c]);
  taps->weights += weight;
}

static inline void load_sources(Sources sources, int i, real* values) {
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) values[c] = source_at(sources, c, i);
}

// Sums over the taps in `columns` to either side of each pixel of a row that begins at `here`, and in `rows` above and below: constants. What
// lies beside the image may be NaN.
static inline __attribute__((always_inline)) void sum_taps_around(Taps* taps, Frame frame, TangentPlane plane, integer x,
                                                                  int y, int here, int columns, int rows,
                                                                  Sources sources, global const float* depth,
                                                                  global const float* normal_x,
                                                                  global const float* normal_y,
                                                                  global const float* normal_z) {
  real values[COMPONENTS];
  load_sources(sources, here, values);
  *taps = own_tap(values);
  for (int j = -rows; j <= rows; ++j) {
    if (y + j < 0 || y + j >= frame.height) continue;
#pragma unroll
    for (int i = -columns; i <= columns; ++i) {
      if (i == 0 && j == 0) continue;
      const int there = here + j * frame.pitch + i;
      const real step = rows == 0      ? (scalar)i * plane.per_column
                        : columns == 0 ? (scalar)j * plane.per_row
                                       : (scalar)i * plane.per_column + (scalar)j * plane.per_row;
      const real weight =
          window_at(i, columns) * window_at(j, rows) *
          same_surface(plane, frame, step, load(depth, there), load3(normal_x, normal_y, normal_z, there));
      const mask in_row = columns == 0 ? EVERY_LANE : to_mask(to_natural(x + i) < (natural)((uint)frame.width));
      load_sources(sources, there, values);
#pragma unroll
      for (int c = 0; c < COMPONENTS; ++c) values[c] = choose(in_row, values[c], (real)(0));
      add_tap(taps, choose(in_row, weight, (real)(0)), values);
    }
  }
}

// As sum_taps_around for the taps above and below. `values`: of the pixels of 2 * rows + 1 rows, one component after another in each.
static inline __attribute__((always_inline)) void sum_taps_along_column(Taps* taps, Frame frame, TangentPlane plane, int y,
                                                                        int here, int rows, const real* values,
                                                                        global const float* depth,
                                                                        global const float* normal_x,
                                                                        global const float* normal_y,
                                                                        global const float* normal_z) {
  *taps = own_tap(values + rows * COMPONENTS);
#pragma unroll
  for (int j = -rows; j <= rows; ++j) {
    if (j == 0 || y + j < 0 || y + j >= frame.height) continue;
    const int there = here + j * frame.pitch;
    const real weight =
        window_at(j, rows) * same_surface(plane, frame, (scalar)j * plane.per_row, load(depth, there),
                                          load3(normal_x, normal_y, normal_z, there));
    add_tap(taps, weight, values + (rows + j) * COMPONENTS);
  }
}
#endif
