// The cross-bilateral filter of bilateral.h for two eyes (Shi, Billeter, Eisemann 2022, section 3.3). F and F* are a surface's
// filtered values in either eye, W and W* the sums of their weights. result = w F + (1 - w) F*, with w = smoothstep(0.5 - blend,
// 0.5 + blend, W / (W + W*)): the eye that sees more of the surface decides, the same for both eyes.
//
// The paper filters the other eye's pixels anew around each pixel of this eye. Here each eye filters its own once, and F* and W*
// are read between the other's pixels: half the work. The paper's step ends at one half, so each eye keeps its own value of what
// both see alike; a step centred at one half gives both eyes the same value.
//
// bilateral_weighted  in : source, source_weights, depth, normal  source_weights: from the pass before (WITH_SOURCE_WEIGHTS)
//                     out: result, result_weights                 F and W
// stereo_blend        in : source, source_weights, depth, normal  of this eye, and of the other
//                     out: result
// Sources and results have COMPONENTS components each, weights one; background is as components.h says.
// -D COLUMNS, ROWS, COMPONENTS
#ifndef GLOAM_STEREO_FILTER_H
#define GLOAM_STEREO_FILTER_H

#include "shared/filter/bilateral.h"
#include "shared/stereo/fetch.h"

// in : source, depth, normal; source_weights
// out: result, result_weights
kernel void bilateral_weighted(ARGUMENTS) {
  const Sources sources = SOURCE_PLANES(source);
  const Results results = RESULT_PLANES(result);
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  const real z = load(depth, here);
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(x), (real)(y), z, load3(normal_x, normal_y, normal_z, here),
                       params.depth_tolerance * params.radius, params.normal_tolerance);
  Taps taps;
  sum_taps_around(&taps, frame, plane, x, y, here, COLUMNS, ROWS, sources, depth, normal_x, normal_y, normal_z);
  const mask is_surface = !is_background(z);
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c)
    store(choose(is_surface, mean_of(taps.sums[c], taps.weights), NO_RESULT), results.planes[c], here);
#if WITH_SOURCE_WEIGHTS
  const real before = load(source_weights, here);
#else
  const real before = (real)(1);
#endif
  store(choose(is_surface, before * taps.weights, (real)(0)), result_weights, here);
}

// 0 below `from`, 1 above `to`, and smooth in between.
static inline real smooth_step(scalar from, scalar to, real value) {
  const scalar width = max(to - from, (scalar)1e-6f);
  const real t = smaller(larger((value - from) * ((scalar)1 / width), (real)(0)), (real)(1));
  return t * t * (3 - 2 * t);
}

// in : source, source_weights, depth, normal, other_source, other_weights, other_depth, other_normal
// out: result
kernel void stereo_blend(ARGUMENTS) {
  const Sources sources = SOURCE_PLANES(source), others = SOURCE_PLANES(other_source);
  const Results results = RESULT_PLANES(result);
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here), own_weight = load(source_weights, here);
  Between b;
  between_pixels(neighbour, project_row(frame, neighbour, z), load3(normal_x, normal_y, normal_z, here),
                 params.depth_tolerance * params.radius, params.normal_tolerance,
                 surface_planes(other_depth, other_normal_x, other_normal_y, other_normal_z), IN_A_ROW, &b);
  real w = (real)(1);
  if (ANY(b.is_known)) {
    const real other_weight =
        quotient(weighted_between(&b, neighbour.frame, IN_A_ROW, other_weights), choose(b.is_known, b.share, (real)(1)));
    const real weight = b.share * other_weight;
    w = smooth_step((scalar)0.5 - params.blend, (scalar)0.5 + params.blend, quotient(own_weight, own_weight + weight));
  }
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) {
    const real own = load(sources.planes[c], here);
    real blended = own;
    if (ANY(b.is_known)) {
      const real found = fetch_between(&b, neighbour.frame, others.planes[c]);
      blended = choose(b.is_known, found + w * (own - found), own);
    }
    store(blended, results.planes[c], here);
  }
}
#endif
