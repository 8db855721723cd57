// Pixels that no edge-preserving filter averages (bilateral.h): none of their four neighbours shows the same surface. Their own samples
// are all that they get.
#ifndef GLOAM_ISOLATED_H
#define GLOAM_ISOLATED_H

#include "shared/frame/surface.h"

// As the filter's defaults (bilateral_params.h).
#define ISOLATED_DISTANCE ((scalar)0.05f)  // radii
#define ISOLATED_ANGLE ((scalar)0.5f)

// For the row of pixels that begins at column x of row y, with these depths (> 0) and normals.
static inline mask is_isolated(Frame frame, int x, int y, real z, real3 n, scalar radius, PLANE depth, PLANE normal_x,
                               PLANE normal_y, PLANE normal_z) {
  const integer column = x + IOTA;
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(column), (real)(y), z, n, ISOLATED_DISTANCE * radius, ISOLATED_ANGLE);
  const int here = index_of(frame, x, y);
  mask found = (mask)(0);
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const int dx = k == 0 ? -1 : k == 1 ? 1 : 0, dy = k == 2 ? -1 : k == 3 ? 1 : 0;
    if (y + dy < 0 || y + dy >= frame.height) continue;
    const int there = here + dy * frame.pitch + dx;
    const real step = (scalar)dx * plane.per_column + (scalar)dy * plane.per_row;
    const real weight =
        same_surface(plane, frame, step, load(depth, there), load3(normal_x, normal_y, normal_z, there));
    found |= (weight > 0) & to_mask(to_natural(column + dx) < (natural)((uint)frame.width));
  }
  return !found;
}

#endif
