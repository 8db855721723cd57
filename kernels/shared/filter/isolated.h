// Pixels that no edge-preserving filter averages (bilateral.h): none of their four neighbours shows the same surface. Their own samples
// are all that they get.
#ifndef GLOAM_ISOLATED_H
#define GLOAM_ISOLATED_H

#include "shared/frame/surface.h"

// As the filter's defaults (bilateral_params.h).
#define ISOLATED_DISTANCE ((scalar)0.05f)  // radii
#define ISOLATED_ANGLE ((scalar)0.5f)

// Of the two neighbours at a distance of (dx, dy), columns and rows, on either side, whether one shows the same surface.
static inline mask has_neighbour(Frame frame, TangentPlane plane, integer column, int y, int here, int dx, int dy,
                                 PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z) {
  mask found = (mask)(0);
#pragma unroll
  for (int sign = -1; sign <= 1; sign += 2) {
    if (y + sign * dy < 0 || y + sign * dy >= frame.height) continue;
    const int there = here + sign * (dy * frame.pitch + dx);
    const real step = (scalar)(sign * dx) * plane.per_column + (scalar)(sign * dy) * plane.per_row;
    const real weight =
        same_surface(plane, frame, step, load(depth, there), load3(normal_x, normal_y, normal_z, there));
    found |= (weight > 0) & to_mask(to_natural(column + sign * dx) < (natural)((uint)frame.width));
  }
  return found;
}

// For those of the row of pixels that begins at column x of row y for which `counts` holds, with these depths (> 0) and normals.
static inline mask is_isolated(Frame frame, int x, int y, mask counts, real z, real3 n, scalar radius, PLANE depth,
                               PLANE normal_x, PLANE normal_y, PLANE normal_z) {
  const integer column = x + IOTA;
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(column), (real)(y), z, n, ISOLATED_DISTANCE * radius, ISOLATED_ANGLE);
  const int here = index_of(frame, x, y);
  counts &= !has_neighbour(frame, plane, column, y, here, 1, 0, depth, normal_x, normal_y, normal_z);
  // Most rows lie on surfaces, and are done.
  if (ANY(counts)) counts &= !has_neighbour(frame, plane, column, y, here, 0, 1, depth, normal_x, normal_y, normal_z);
  return counts;
}

#endif
