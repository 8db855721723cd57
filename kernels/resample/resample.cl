// From the whole image to every `scale`-th pixel each way, and back by joint bilateral upsampling (Kopf, Cohen,
// Lischinski, Uyttendaele 2007).
//
// subsample: `frame`: the reduced one; `other`: the whole. Pixel (x, y) is pixel (x, y) * SCALE of the whole.
// joint_upsample (OpenCL has an `upsample` of its own): `frame`: the whole; `other`: the reduced one (upsample.h).
// joint_upsample_of_both: from the reduced pixels of two views that agree (shared/stereo/upsample.h); `neighbour`: the other view,
// reduced.
// -D SCALE, SOURCE_LAYERS (subsample_stack), OUTSIDE (joint_upsample, _color, _color_alpha: the value of background and of unknown
//    pixels), UNIT_INTERVAL (1: the plane is at most 1), TWO_VIEWS, COMPONENTS (joint_upsample_of_both)
#include "shared/filter/upsample.h"
#include "shared/lanes/wanted.h"
#if TWO_VIEWS
#include "shared/lanes/components.h"
#include "shared/stereo/upsample.h"
#endif

#if UNIT_INTERVAL
#define MEAN mean_up_to_one
#else
#define MEAN quotient
#endif

static inline void subsample_plane(Frame frame, Frame other, PLANE source, PLANE_OUT result) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  store(gather(source + from, IOTA * (integer)(SCALE)), result, to);
}

// in : source
// out: result
kernel void subsample(ARGUMENTS) {
  subsample_plane(frame, other, source, result);
}

// in : source
// out: result
kernel void subsample_vector(ARGUMENTS) {
  subsample_plane(frame, other, source_x, result_x);
  subsample_plane(frame, other, source_y, result_y);
  subsample_plane(frame, other, source_z, result_z);
}

// in : source
// out: result
kernel void subsample_color(ARGUMENTS) {
  subsample_plane(frame, other, source_r, result_r);
  subsample_plane(frame, other, source_g, result_g);
  subsample_plane(frame, other, source_b, result_b);
}

#ifdef SOURCE_LAYERS
// in : source
// out: result
kernel void subsample_stack(ARGUMENTS) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  for (int k = 0; k < SOURCE_LAYERS; ++k) {
    const real depth = gather(layer_of(source, other, k) + from, IOTA * (integer)(SCALE));
    store(depth, layer_of_out(result, frame, k), to);
  }
}
#endif

#ifdef OUTSIDE
// in : source, low_depth, low_normal, depth, normal; wanted
// out: result
kernel void joint_upsample(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(OUTSIDE), result, here))
  const Site s = site_at(frame, other, params.depth_tolerance * params.radius, params.normal_tolerance, depth, normal_x,
                         normal_y, normal_z);
  const Weights w = weights_of(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const mask known = !is_background(s.plane.depth) & (w.total > 0);
  const real mean = MEAN(weighted(w, s, source), choose(known, w.total, (real)(1)));
  store(choose(known & is_wanted, mean, (real)(OUTSIDE)), result, s.here);
}
#endif

#if TWO_VIEWS
// in : source, low_depth, low_normal, depth, normal, other_source, other_depth, other_normal
// out: result
kernel void joint_upsample_of_both(ARGUMENTS) {
  const Sources sources = SOURCE_PLANES(source), other_sources = SOURCE_PLANES(other_source);
  const Results results = RESULT_PLANES(result);
  const scalar distance = params.depth_tolerance * params.radius;
  const Site s = site_at(frame, other, distance, params.normal_tolerance, depth, normal_x, normal_y, normal_z);
  const Weights w = weights_of_same(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const Projection there = project_row_into_reduced(frame, neighbour, s.plane.depth);
  const SurfacePlanes planes = surface_planes(low_depth, low_normal_x, low_normal_y, low_normal_z);
  const SurfacePlanes others = surface_planes(other_depth, other_normal_x, other_normal_y, other_normal_z);
  Between b;
  between_pixels(neighbour, there, load3(normal_x, normal_y, normal_z, s.here), distance, params.normal_tolerance,
                 others, WITHIN_A_LOAD, &b);
  const mask is_surface = !is_background(s.plane.depth);
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) {
    Mixture m;
    m.sum = weighted(w, s, sources.planes[c]);
    m.total = w.total;
    mix_between(&m, &b, there, neighbour.frame, other_sources.planes[c]);
    const real counts = choose(is_surface, share_of_farther(m), (real)(0));
    if (ANY(counts > 0)) {
      mix_around_own(&m, s, other, counts, planes, sources.planes[c]);
      mix_around_other(&m, &b, there, neighbour.frame, counts, others, other_sources.planes[c]);
    }
    const mask known = is_surface & (m.total > 0);
    store(choose(known, MEAN(m.sum, choose(known, m.total, (real)(1))), (real)(OUTSIDE)), results.planes[c], s.here);
  }
}
#endif

// in : source, low_depth, low_normal, depth, normal; wanted
// out: result
kernel void joint_upsample_vector(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(0), result_x, here); store((real)(0), result_y, here);
                store((real)(0), result_z, here))
  const Site s = site_at(frame, other, params.depth_tolerance * params.radius, params.normal_tolerance, depth, normal_x,
                         normal_y, normal_z);
  const Weights w = weights_of(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const real3 sum = make3(weighted(w, s, source_x), weighted(w, s, source_y), weighted(w, s, source_z));
  const real square = dot3(sum, sum);
  const mask usable = square > (scalar)1e-6f * w.total * w.total;
  const real3 unit = scale3(sum, inverse_sqrt(choose(usable, square, (real)(1))));
  const real3 direction = choose3(usable, unit, load3(normal_x, normal_y, normal_z, s.here));
  const real sign = choose(is_background(s.plane.depth) | !is_wanted, (real)(0), (real)(1));
  store(direction.x * sign, result_x, s.here);
  store(direction.y * sign, result_y, s.here);
  store(direction.z * sign, result_z, s.here);
}

#ifdef OUTSIDE
static inline void upsample_plane(Weights w, Site s, mask known, PLANE source, PLANE_OUT result) {
  const real total = choose(known, w.total, (real)(1));
  store(choose(known, MEAN(weighted(w, s, source), total), (real)(OUTSIDE)), result, s.here);
}

static inline void upsample_share(Weights w, Site s, mask known, PLANE source, PLANE_OUT result) {
  const real total = choose(known, w.total, (real)(1));
  store(choose(known, mean_up_to_one(weighted(w, s, source), total), (real)(OUTSIDE)), result, s.here);
}

// in : source, low_depth, low_normal, depth, normal; wanted
// out: result
kernel void joint_upsample_color(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(OUTSIDE), result_r, here); store((real)(OUTSIDE), result_g, here);
                store((real)(OUTSIDE), result_b, here))
  const Site s = site_at(frame, other, params.depth_tolerance * params.radius, params.normal_tolerance, depth, normal_x,
                         normal_y, normal_z);
  const Weights w = weights_of(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const mask known = !is_background(s.plane.depth) & (w.total > 0) & is_wanted;
  upsample_plane(w, s, known, source_r, result_r);
  upsample_plane(w, s, known, source_g, result_g);
  upsample_plane(w, s, known, source_b, result_b);
}

// in : source, low_depth, low_normal, depth, normal; wanted
// out: result
kernel void joint_upsample_color_alpha(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(OUTSIDE), result_r, here); store((real)(OUTSIDE), result_g, here);
                store((real)(OUTSIDE), result_b, here); store((real)(OUTSIDE), result_a, here))
  const Site s = site_at(frame, other, params.depth_tolerance * params.radius, params.normal_tolerance, depth, normal_x,
                         normal_y, normal_z);
  const Weights w = weights_of(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const mask known = !is_background(s.plane.depth) & (w.total > 0) & is_wanted;
  upsample_plane(w, s, known, source_r, result_r);
  upsample_plane(w, s, known, source_g, result_g);
  upsample_plane(w, s, known, source_b, result_b);
  upsample_share(w, s, known, source_a, result_a);
}
#endif
