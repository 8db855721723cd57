// The other eye's values for this eye's surfaces, read between its pixels: of the four pixels around a position those that show
// the surface count, by how near they are, by their distance from its tangent plane and by the angle between the normals.
#ifndef GLOAM_STEREO_FETCH_H
#define GLOAM_STEREO_FETCH_H

#include "shared/frame/neighbour.h"
#include "shared/frame/surface.h"
#include "shared/lanes/components.h"
#include "shared/lanes/pixel_row.h"

// The planes that describe the other eye's surfaces.
typedef struct {
  global const float *depth, *normal_x, *normal_y, *normal_z;
} SurfacePlanes;

static inline SurfacePlanes surface_planes(global const float* depth, global const float* normal_x,
                                           global const float* normal_y, global const float* normal_z) {
  SurfacePlanes p;
  p.depth = depth;
  p.normal_x = normal_x;
  p.normal_y = normal_y;
  p.normal_z = normal_z;
  return p;
}

typedef struct {
  TangentPlane plane;  // of the surface, in the other eye
  PixelRow pixels;     // upper left of the four pixels
  real right, below;   // from that pixel to the position
  int how;             // arrangement of the pixels: as expected, or ANYWHERE
  real weights[4];     // of the four pixels
  real share;          // sum of the weights, 0 to 1
  mask is_known;
} Between;

static inline __attribute__((always_inline)) void weigh_pixels(Between* b, Frame f, SurfacePlanes planes, int how) {
  const TangentPlane plane = b->plane;
  const real x = b->right, y = b->below;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const int i = k % 2, j = k / 2;
    const real step = ((scalar)i - x) * plane.per_column + ((scalar)j - y) * plane.per_row;
    const real depth = fabs(value_at(f, planes.depth, &b->pixels, i, j, how));
    const real3 n =
        make3(value_at(f, planes.normal_x, &b->pixels, i, j, how), value_at(f, planes.normal_y, &b->pixels, i, j, how),
              value_at(f, planes.normal_z, &b->pixels, i, j, how));
    const real near = (i ? x : 1 - x) * (j ? y : 1 - y);
    const real weight = near * same_surface(plane, f, step, depth, n);
    const mask is_inside = to_mask((to_natural(b->pixels.column + i) < (natural)((uint)f.width)) &
                                   (to_natural(b->pixels.row + j) < (natural)((uint)f.height)));
    b->weights[k] = choose(is_inside & !is_background(depth), weight, (real)(0));
  }
}

// Weighs the four pixels around `there`. `normal`: of the surface, in this eye's space; `distance`, `angle`: tangent_plane_at;
// `expected`: arrangement of the pixels (pixel_row.h) along most surfaces, a constant.
static inline __attribute__((always_inline)) void between_pixels(Neighbour neighbour, Projection there, real3 normal,
                                                                 scalar distance, scalar angle, SurfacePlanes planes,
                                                                 int expected, Between* b) {
  const Frame other = neighbour.frame;
  b->share = (real)(0);
  b->is_known = there.is_seen;
  b->how = ANYWHERE;
  if (!ANY(there.is_seen)) return;
  b->plane = tangent_plane_at(other, there.x, there.y, there.depth, rotated(neighbour, normal), distance, angle);
  // Parallel eyes see the point in the same row but for rounding, which must not choose the row lane by lane.
  const integer column = nearest(floor(there.x + (scalar)0x1p-10)), row = nearest(floor(there.y + (scalar)0x1p-10));
  b->right = larger(there.x - to_real(column), (real)(0));
  b->below = larger(there.y - to_real(row), (real)(0));
  b->how = expected == WITHIN_A_LOAD ? lie_within_a_load(column, row, there.is_seen, &b->pixels)
                                     : follow_in_a_row(column, row, there.is_seen, &b->pixels);
  if (b->how == expected)
    weigh_pixels(b, other, planes, expected);
  else
    weigh_pixels(b, other, planes, ANYWHERE);
  b->share = b->weights[0] + b->weights[1] + b->weights[2] + b->weights[3];
  b->is_known &= b->share > (scalar)1e-3f;
}

static inline __attribute__((always_inline)) real weighted_sum(const Between* b, Frame f, global const float* plane,
                                                               int how) {
  real sum = b->weights[0] * value_at(f, plane, &b->pixels, 0, 0, how);
#pragma unroll
  for (int k = 1; k < 4; ++k) sum = multiply_add(b->weights[k], value_at(f, plane, &b->pixels, k % 2, k / 2, how), sum);
  return sum;
}

// Weighted sum of a plane of the other eye. `expected`: as given to between_pixels.
static inline __attribute__((always_inline)) real weighted_between(const Between* b, Frame other, int expected,
                                                                   global const float* plane) {
  return b->how == expected ? weighted_sum(b, other, plane, expected) : weighted_sum(b, other, plane, ANYWHERE);
}

// Weighted mean of a component of the other eye (components.h), valid where `is_known`. The pixels were expected in a row.
static inline __attribute__((always_inline)) real fetch_between(const Between* b, Frame other,
                                                                global const float* plane) {
  return mean_of(weighted_between(b, other, IN_A_ROW, plane), choose(b->is_known, b->share, (real)(1)));
}

#endif
