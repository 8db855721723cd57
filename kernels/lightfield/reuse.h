// Reuses the AO of key views that show the same points.
#ifndef GLOAM_LIGHTFIELD_REUSE_H
#define GLOAM_LIGHTFIELD_REUSE_H

#include "lightfield/spot.h"

// Pixels within this many radii of the nearest pixel's depth count as the same surface.
#define SAME_DEPTH ((scalar)0.1f)

// A plane read between pixels. Of the four pixels around (x, y) those count that are at the depth of the nearest one, `depth`.
static inline real fetched_at(Frame f, real x, real y, integer nearest_place, real depth, scalar tolerance,
                              global const float* depths, global const float* plane) {
  // Rounded to 1/256 pixel, so that a pixel centre stays one in spite of rounding.
  const real snapped_x = to_real(nearest(x * 256)) * (scalar)(1.0f / 256);
  const real snapped_y = to_real(nearest(y * 256)) * (scalar)(1.0f / 256);
  const integer column = nearest(floor(snapped_x)), row = nearest(floor(snapped_y));
  const real right = snapped_x - to_real(column), below = snapped_y - to_real(row);
  real sum = 0, weights = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const int i = k % 2, j = k / 2;
    const real weight = (i ? right : 1 - right) * (j ? below : 1 - below);
    const integer to_x = clamp(column + i, (integer)(0), (integer)(f.width - 1));
    const integer to_y = clamp(row + j, (integer)(0), (integer)(f.height - 1));
    // Rows are the same in all modules of a straight display.
    if (!ANY(weight > 0)) continue;
    const integer place = FRAME_GUARD + to_y * f.pitch + to_x;
    const mask counts = fabs(gather(depths, place) - depth) <= tolerance;
    sum += choose(counts, weight * gather(plane, place), (real)(0));
    weights += choose(counts, weight, (real)(0));
  }
  const mask is_known = weights > (scalar)0x1p-8f;
  return choose(is_known, mean_up_to_one(sum, choose(is_known, weights, (real)(1))), gather(plane, nearest_place));
}

// AO that a key view has at the pixel where it shows a point `v` (view space of the pixel at hand), and whether it shows that
// point: what it shows there projects back to within `back_check` pixels of the pixel.
static inline real found_in(Frame f, PROJECTIONS own, PROJECTIONS key, Params params, real x, real y, real3 v,
                            mask is_asked, Surfaces planes, global const float* ao, mask* is_found) {
  real there_x, there_y, back_x, back_y;
  mask is_inside, is_back;
  project_within(key, f, into_view(key, v), is_asked, &there_x, &there_y, &is_inside);
  *is_found = is_inside;
  if (!ANY(is_inside)) return (real)(1);
  const integer column = nearest(there_x), row = nearest(there_y);
  const integer place = FRAME_GUARD + row * f.pitch + column;
  const real depth = gather(planes.depth, place);
  const mask is_surface = is_inside & !is_background(depth);
  real3 seen;
  if (key->is_straight)
    seen = point_at(key, to_real(column), to_real(row), choose(is_surface, depth, (real)(1)));
  else
    seen = view_of_position(key, gather3(planes.position_x, planes.position_y, planes.position_z, place));
  project_within(own, f, back_from_view(key, seen), is_surface, &back_x, &back_y, &is_back);
  const real dx = back_x - x, dy = back_y - y;
  *is_found = is_back & (dx * dx + dy * dy <= params.back_check * params.back_check);
  if (!ANY(*is_found)) return (real)(1);
  return fetched_at(f, there_x, there_y, place, depth, SAME_DEPTH * params.radius, planes.depth, ao);
}

// Copies a key view's AO, which was computed without the mask, for the pixels that the mask wants.
// in : ao_of_key; wanted
// out: ao_raw
kernel void lightfield_key(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  store(choose(is_wanted, load(ao_of_key, here), (real)(1)), ao_raw, here);
}

// in : depth, position, key_depth, key_position, key_ao, far_depth, far_position, far_ao; wanted
// out: ao_raw, newly_visible
kernel void lightfield_reuse(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const mask in_row = to_mask(FIRST_X + IOTA < frame.width);
  const mask is_surface = is_wanted & in_row & !is_background(load(depth, here));
  const real3 v = view_of_position(projections, load3(position_x, position_y, position_z, here));
  mask is_found, is_found_far = (mask)(0);
  real open = found_in(frame, projections, projections + 1, params, x, y, v, is_surface,
                       surfaces_of(key_depth, key_position_x, key_position_y, key_position_z), key_ao, &is_found);
#if FROM_BOTH
  // A mean of both has less noise, and fades between views whose screen-space AO differs.
  const mask is_asked = is_surface;
  const scalar share = projections[2].share;
#else
  const mask is_asked = is_surface & !is_found;
  const scalar share = 0;
#endif
  if (projections[2].share > 0 && ANY(is_asked)) {
    const real far =
        found_in(frame, projections, projections + 2, params, x, y, v, is_asked,
                 surfaces_of(far_depth, far_position_x, far_position_y, far_position_z), far_ao, &is_found_far);
    open = choose(is_found, multiply_add(share, choose(is_found_far, far - open, (real)(0)), open), far);
    is_found |= is_found_far;
  }
  store(choose(is_found, open, (real)(1)), ao_raw, here);
  append_pixels(newly_visible, here, is_surface & !is_found);
}

#endif
