// Cross-bilateral filter (Petschnigg et al. 2004, Eisemann and Durand 2004), along one axis or over both at once. A tap
// counts by its distance on the screen, by its distance from the pixel's tangent plane and by the angle between the
// normals; each weight ends at 0.
//
// in : source  to be filtered      depth  view-space z, scene units, +inf = background      normal  unit, view space
// out: result  filtered; 1 on background
// -D COLUMNS, ROWS: taps to the left and to the right, above and below
#include "bilateral/params.h"
#include "shared/surface.h"

// Biweight: 1 at the pixel, 0 one pixel beyond the last tap.
static inline scalar window_at(int k, int taps) {
  const scalar t = (scalar)k * ((scalar)1 / (taps + 1));
  return (1 - t * t) * (1 - t * t);
}

kernel void bilateral(Frame frame, BilateralParams params, PLANE source, PLANE depth, PLANE normal_x, PLANE normal_y,
                      PLANE normal_z, PLANE_OUT result) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  const real z = load(depth, here);
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(x), (real)(y), z, load3(normal_x, normal_y, normal_z, here),
                       params.depth_tolerance * params.radius, params.normal_tolerance);
  real sum = load(source, here), weights = 1;
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
      const real counts = choose(in_row, weight, (real)(0));
      sum = multiply_add(counts, load(source, there), sum);
      weights += counts;
    }
  }
  // Divided exactly, so that what is open all around stays just that.
  store(choose(is_background(z), (real)(1), sum / weights), result, here);
}
