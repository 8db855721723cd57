// Passes of two eyes (stereo.h), whatever is estimated.
//
// stereo_visibility   in : depth, other_depth  view-space z of either eye, scene units, +inf = background
//                     out: stereo_depth        negative where both eyes see the surface
// stereo_reproject    in : depth, other_depth  as left by stereo_visibility;  other  the other eye's result, 0 to 1
//                     out: result              what the other eye found where both see the surface, 1 on background;
//                          newly_visible       what is left to be computed (pixel_list.h)
// -D NO_BACK_CHECK (stereo_reproject), WITH_PIXEL_LIST (stereo_visibility empties it)
#ifndef GLOAM_STEREO_PASSES_H
#define GLOAM_STEREO_PASSES_H

#include "shared/pixel_list.h"
#include "shared/stereo.h"
#include "shared/surface.h"

#if WITH_PIXEL_LIST
#define PIXEL_LIST_OUT_ARGUMENT , PIXEL_LIST_OUT newly_visible
#else
#define PIXEL_LIST_OUT_ARGUMENT
#endif

kernel void stereo_visibility(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE other_depth,
                              PLANE_OUT stereo_depth PIXEL_LIST_OUT_ARGUMENT) {
#if WITH_PIXEL_LIST
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(newly_visible);
#endif
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here);
  const mask is_seen = seen_by_both_eyes(frame, neighbour, params.back_check, z, other_depth);
  store(stereo_depth_of(z, is_seen), stereo_depth, here);
}

#if WITH_PIXEL_LIST
// Without a back-check what the other eye sees only has to be as far away as the pixel's surface.
#define SAME_DEPTH ((scalar)0.02)

// What the other eye found at a place between its pixels: of the four around it those that show the pixel's surface count,
// by how near they are and by their distance from its tangent plane.
static inline real value_between(Frame other, TangentPlane plane, Projection there, PLANE other_depth, PLANE values) {
  const integer column = nearest(floor(there.x)), row = nearest(floor(there.y));
  const real x = there.x - to_real(column), y = there.y - to_real(row);
  const integer nearest_pixel = nearest_index(other, there);
  real sum = 0, weights = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const int i = k % 2, j = k / 2;
    const integer index = FRAME_GUARD + clamp(row + j, (integer)(0), (integer)(other.height - 1)) * other.pitch +
                          clamp(column + i, (integer)(0), (integer)(other.width - 1));
    const real step = ((scalar)i - x) * plane.per_column + ((scalar)j - y) * plane.per_row;
    const real distance = fabs(distance_from(plane, other, step, fabs(gather(other_depth, index))));
    const real share = (i ? x : 1 - x) * (j ? y : 1 - y);
    const real weight = choose(distance < 1, share * (1 - distance), (real)(0));
    sum = multiply_add(weight, gather(values, index), sum);
    weights += weight;
  }
  const mask is_known = weights > (scalar)1e-3f;
  return choose(is_known, sum / choose(is_known, weights, (real)(1)), gather(values, nearest_pixel));
}

kernel void stereo_reproject(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x,
                             PLANE normal_y, PLANE normal_z, PLANE other_depth, PLANE other, PLANE_OUT result,
                             PIXEL_LIST_OUT newly_visible) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y), stored_depth = load(depth, here), z = fabs(stored_depth);
  const Projection there =
      project_into(neighbour, position_at(frame, x, y, choose(is_background(z), (real)(1), z)), !is_background(z));
#if NO_BACK_CHECK
  const real depth_there = fabs(gather(other_depth, nearest_index(neighbour.frame, there)));
  const mask is_found = there.is_seen & (fabs(depth_there - there.depth) < SAME_DEPTH * there.depth);
#else
  const mask is_found = is_shared(stored_depth);
#endif
  real found = (real)(1);
  if (ANY(is_found)) {
    const TangentPlane plane = tangent_plane_at(neighbour.frame, there.x, there.y, there.depth,
                                                rotated(neighbour, load3(normal_x, normal_y, normal_z, here)),
                                                params.depth_tolerance * params.radius, params.normal_tolerance);
    found = choose(is_found, value_between(neighbour.frame, plane, there, other_depth, other), (real)(1));
  }
  store(found, result, here);
  const mask in_row = to_mask(FIRST_X + IOTA < frame.width);
  append_pixels(newly_visible, here, !is_found & !is_background(z) & in_row);
}
#endif

#endif
