// Passes for two eyes (visibility.h), whatever the technique estimates.
//
// stereo_visibility   in : depth, other_depth  view-space z of either eye, scene units, +inf = background
//                     out: stereo_depth        negative where both eyes see the surface
// stereo_reproject    in : depth, other_depth    as left by stereo_visibility
//                          normal, other_normal  unit, view space
//                          other                 the other eye's result
//                     out: result                the other eye's result where both see the surface and its pixels show it; else that
//                                                of background
//                          newly_visible         pixels left to be computed (pixel_list.h)
// stereo_half_occlusion in : depth           as left by stereo_visibility
//                       out: half_occluded   cells near surfaces that this eye alone sees (half_occlusion.h)
// -D COMPONENTS (of results), NO_BACK_CHECK (stereo_reproject), WITH_PIXEL_LIST, WITH_HALF_OCCLUSION (stereo_visibility empties these)
#ifndef GLOAM_STEREO_PASSES_H
#define GLOAM_STEREO_PASSES_H

#include "shared/lanes/components.h"
#include "shared/lanes/pixel_list.h"
#include "shared/stereo/fetch.h"
#include "shared/stereo/half_occlusion.h"
#include "shared/stereo/visibility.h"

// in : depth, other_depth
// out: stereo_depth; newly_visible, half_occluded
kernel void stereo_visibility(ARGUMENTS) {
#if WITH_PIXEL_LIST
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(newly_visible);
#endif
  const int here = index_of(frame, FIRST_X, ROW_Y);
#if WITH_HALF_OCCLUSION
  empty_cells(half_occluded, frame, here);
#endif
  const real z = load(depth, here);
  const mask is_seen = seen_by_both_eyes(frame, neighbour, params.back_check, z, other_depth);
  store(stereo_depth_of(z, is_seen), stereo_depth, here);
}

#if WITH_HALF_OCCLUSION
// in : depth
// out: half_occluded
kernel void stereo_half_occlusion(ARGUMENTS) {
  const real z = fabs(load(depth, index_of(frame, FIRST_X, ROW_Y)));
  mark_around_all(half_occluded, frame, position_at(frame, to_real(FIRST_X + IOTA), (real)(ROW_Y), z), params.radius,
                  is_half_occluded(depth, frame));
}
#endif

#if WITH_PIXEL_LIST
// NO_BACK_CHECK: share by which the other eye's depth may differ from that of the pixel's surface.
#define SAME_DEPTH ((scalar)0.02)

// in : depth, normal, other_depth, other_normal, other
// out: result, newly_visible
kernel void stereo_reproject(ARGUMENTS) {
  const Sources others = SOURCE_PLANES(other);
  const Results results = RESULT_PLANES(result);
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real stored_depth = load(depth, here), z = fabs(stored_depth);
  const Projection there = project_row(frame, neighbour, z);
#if NO_BACK_CHECK
  const real depth_there = fabs(gather(other_depth, nearest_index(neighbour.frame, there)));
  const mask is_found = there.is_seen & (fabs(depth_there - there.depth) < SAME_DEPTH * there.depth);
#else
  mask is_found = is_shared(stored_depth);
#endif
  Between b;
  between_pixels(neighbour, there, load3(normal_x, normal_y, normal_z, here), params.depth_tolerance * params.radius,
                 params.normal_tolerance, surface_planes(other_depth, other_normal_x, other_normal_y, other_normal_z),
                 IN_A_ROW, &b);
#if !NO_BACK_CHECK
  is_found &= b.is_known;
#endif
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) {
    real found = NO_RESULT;
    if (ANY(is_found))
      found = choose(b.is_known, fetch_between(&b, neighbour.frame, others.planes[c]),
                     gather(others.planes[c], nearest_index(neighbour.frame, there)));
    store(choose(is_found, found, NO_RESULT), results.planes[c], here);
  }
  const mask in_row = to_mask(FIRST_X + IOTA < frame.width);
  append_pixels(newly_visible, here, !is_found & !is_background(z) & in_row);
}
#endif

// The filters, for passes that define their taps.
#ifdef COLUMNS
#include "shared/filter/bilateral_filter.h"
#include "shared/stereo/filter.h"
#endif

#endif
