// Taps of a cross-bilateral filter, along one axis or over both at once. A tap counts by its distance on the screen, by its
// distance from the pixel's tangent plane and by the angle between the normals; each of the three weights ends at 0.
// -D COLUMNS, ROWS: taps to the left and to the right, above and below
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

static inline void add_tap(Taps* taps, real weight, mask counts, Sources sources, int there) {
  const real counted = choose(counts, weight, (real)(0));
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c)
    taps->sums[c] = multiply_add(counted, source_at(sources, c, there), taps->sums[c]);
  taps->weights += counted;
}

// Sums over the taps around each pixel of a row that begins at `here`. The pixel itself has weight 1.
static inline Taps taps_around(Frame frame, TangentPlane plane, integer x, int y, int here, Sources sources,
                               PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z) {
  Taps taps;
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) taps.sums[c] = source_at(sources, c, here);
  taps.weights = (real)(1);
#if COLUMNS == 0
#pragma unroll
#endif
  for (int j = -ROWS; j <= ROWS; ++j) {
    if (y + j < 0 || y + j >= frame.height) continue;
#pragma unroll
    for (int i = -COLUMNS; i <= COLUMNS; ++i) {
      if (i == 0 && j == 0) continue;
      const int there = here + j * frame.pitch + i;
      const real step = ROWS == 0      ? (scalar)i * plane.per_column
                        : COLUMNS == 0 ? (scalar)j * plane.per_row
                                       : (scalar)i * plane.per_column + (scalar)j * plane.per_row;
      const real weight =
          window_at(i, COLUMNS) * window_at(j, ROWS) *
          same_surface(plane, frame, step, load(depth, there), load3(normal_x, normal_y, normal_z, there));
      const mask in_row = COLUMNS == 0 ? EVERY_LANE : to_mask(to_natural(x + i) < (natural)((uint)frame.width));
      add_tap(&taps, weight, in_row, sources, there);
    }
  }
  return taps;
}
#endif
