// Kernels that estimate from slices as both eyes see them (Shi, Billeter, Eisemann 2022, section 3.1). Include it after the types
// Search (with a receiver and its surface) and Side (with a sample), and the functions
//   search_of(params, receiver), side_of(slice, search, sign),
//   look(frame, params, layers, search, here, place, in_frame, is_shared, side)   takes a sample; `here`: what `place` starts from
//   closed_to_both(TABLES here, there, own, other, is_seen)                       closed share of a slice, times its importance
// With LIGHT also Search::sources, and
//   start_rays_of_view(view, shift), add_light_to_both(light, here, there, own, other)
// A technique with tables defines TABLE_PARAMETERS and TABLES: the tables as parameters and as arguments, each with a comma.
//
// in : depth, other_depth  view-space z of either eye, scene units, +inf = background; with the sign of visibility.h
//      normal              unit, view space
//      newly_visible       the pixels that stereo_slices_list computes
//      sources, other_sources  what the pixels of either eye send (light_source.h; LIGHT)
// out: ao_raw              1 = open .. 0 = closed, unfiltered; 1 on background; or with LIGHT
//      indirect_raw        the light that arrives, unfiltered; 0 on background
// -D DIRECTIONS, STEPS, OUTSIDE_OPEN, OCCLUDERS_LAYERS, ESTIMATE_MONO, WITH_HALF_OCCLUSION
#ifndef GLOAM_STEREO_SLICES_H
#define GLOAM_STEREO_SLICES_H

#include "shared/stereo/estimate.h"
#include "shared/stereo/passes.h"
#include "shared/stereo/slice_view.h"

#ifndef TABLE_PARAMETERS
#define TABLE_PARAMETERS
#define TABLES
#endif

#if LIGHT
#define SOURCE_PARAMETERS PLANE sources, PLANE other_sources,
#define BOTH_SOURCES sources, other_sources,
#define PUT(put, open, light, at)       \
  put((light).x, indirect_raw_r, (at)); \
  put((light).y, indirect_raw_g, (at)); \
  put((light).z, indirect_raw_b, (at));
#else
#define SOURCE_PARAMETERS
#define BOTH_SOURCES
#define PUT(put, open, light, at) put(open, ao_raw, (at));
#endif

static inline void start_view(View* view, Search search, real turn) {
  real cosine, sine;
  const real inverse_density = draw_slice(search.receiver.point, search.surface, turn, &cosine, &sine);
  view->slice = slice_at(search.receiver.point, search.surface, cosine, sine);
  view->importance = inverse_density * view->slice.weight;
  view->right = side_of(view->slice, search, (scalar)1);
  view->left = side_of(view->slice, search, (scalar)-1);
}

// The sample of a side nearest to (x, y) pixels from a centre. Samples nearer than `least_along` along the tangent are left out.
static inline __attribute__((always_inline)) void look_around(Frame frame, Params params, DepthLayers layers,
                                                              Search search, Slice slice, Centre c, real x, real y,
                                                              real sign, real least_along, mask is_read, mask is_seen,
                                                              int within, Side* side) {
  integer dx = nearest(x - c.left), dy = nearest(y - c.up);
  const real along = sign * ((to_real(dx) + c.left) * slice.along_x + (to_real(dy) + c.up) * slice.along_y);
  // From the unclamped position, as in samples_of_step.
  side->sample.least = params.bias * along;
  mask is_inside;
  const integer place = place_around(frame, c, within, &dx, &dy, &is_inside);
  // A sample on the point's own pixel would hold nothing but rounding.
  mask counts = is_read & (along >= least_along) & to_mask((dx != 0) | (dy != 0));
  if (OUTSIDE_OPEN) counts &= is_inside;
  const real right = to_real(dx) + c.left, below = to_real(dy) + c.up;
  side->sample.along = sign * (right * slice.along_x + below * slice.along_y);
  side->sample.above = right * slice.above_x + below * slice.above_y;
  look(frame, params, layers, search, 0, place, counts, is_seen & is_inside, side);
}

// As search_slice, around a point that need not lie on a pixel centre.
static inline __attribute__((always_inline)) void search_view(Frame frame, Params params, DepthLayers layers,
                                                              Search search, mask is_read, mask is_seen, int within,
                                                              View* view) {
  const Receiver r = search.receiver;
  const Slice slice = view->slice;
  const Centre c = centre_of(frame, r.point);
  const real reach_x = slice.screen_x * r.reach.pixels_x, reach_y = slice.screen_y * r.reach.pixels_y;
  // Around a point between pixels, samples nearer than this lie beside the point rather than along the slice: the little that
  // they rise would look steep. Around a pixel centre no sample is that near.
  const real half_a_pixel = (scalar)0.5 * (reach_x * slice.along_x + reach_y * slice.along_y) *
                            inverse_sqrt(reach_x * reach_x + reach_y * reach_y);
  const real least_along = choose((c.left == 0) & (c.up == 0), (real)(0), half_a_pixel);
  for (int k = 0; k < STEPS; ++k) {
    const real t = distance_of_step(k, r.noise), x = reach_x * t, y = reach_y * t;
    look_around(frame, params, layers, search, slice, c, x, y, (real)(1), least_along, is_read, is_seen, within,
                &view->right);
    look_around(frame, params, layers, search, slice, c, -x, -y, (real)(-1), least_along, is_read, is_seen, within,
                &view->left);
  }
}

// `there`: the point as the other eye shows it, valid where `is_seen`.
static inline __attribute__((always_inline)) real share_open_to_both(TABLE_PARAMETERS Frame frame, Frame other,
                                                                     Params params, DepthLayers layers,
                                                                     DepthLayers other_layers, Search here,
                                                                     Search there, mask is_seen, int within,
                                                                     real3* light) {
  real all_closed = 0;
  *light = make3((real)(0), (real)(0), (real)(0));
#if LIGHT
  const Receiver r = here.receiver;
  const real ray_shift =
      shift_of_rays(to_natural(to_integer(r.point.x)), to_natural(to_integer(r.point.y)), frame.seed);
#endif
  for (int d = 0; d < DIRECTIONS; ++d) {
    const real turn = (scalar)d + here.receiver.noise.turn;
    View own, others;
    start_view(&own, here, turn);
    start_view(&others, there, turn);
#if LIGHT
    const real shift = shift_of_slice(ray_shift, d);
    start_rays_of_view(&own, shift);
    start_rays_of_view(&others, shift);
#endif
    search_view(frame, params, layers, here, EVERY_LANE, is_seen, within, &own);
    if (ANY(is_seen)) search_view(other, params, other_layers, there, is_seen, is_seen, within, &others);
    all_closed += closed_to_both(TABLES here, there, &own, &others, is_seen);
#if LIGHT
    add_light_to_both(light, here, there, &own, &others);
#endif
  }
  return 1 - all_closed * (scalar)(1.0f / DIRECTIONS);
}

// AO of one point per lane, and its light. `may_differ`: lanes that use the other eye.
static inline real open_to_both(TABLE_PARAMETERS SOURCE_PARAMETERS Frame frame, Neighbour neighbour, Params params,
                                DepthLayers layers, DepthLayers other_layers, Receiver receiver, mask may_differ,
                                real3* light) {
  const Frame other = neighbour.frame;
  mask is_seen;
  Receiver receiver_of_other =
      receiver_there(frame, neighbour, params.radius, params.max_reach, receiver, may_differ, &is_seen);
  receiver_of_other.noise = receiver.noise;
  Search here = search_of(params, receiver), there = search_of(params, receiver_of_other);
#if LIGHT
  here.sources.packed = sources;
  there.sources.packed = other_sources;
#endif
  real open;
  if (!is_wide(frame) &&
      reaches_only_inside(frame, receiver.point, longer(receiver.reach, here.surface.length)) &&
      reaches_only_inside(other, receiver_of_other.point, longer(receiver_of_other.reach, there.surface.length)))
    open = share_open_to_both(TABLES frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_INSIDE,
                              light);
  else
    open = share_open_to_both(TABLES frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_CLAMPED,
                              light);
  const mask is_surface = !receiver.point.background;
  light->x = choose(is_surface, light->x, (real)(0));
  light->y = choose(is_surface, light->y, (real)(0));
  light->z = choose(is_surface, light->z, (real)(0));
  return choose(is_surface, smaller(larger(open, (real)(0)), (real)(1)), (real)(1));
}

// in : depth, normal, other_depth; other_half_occluded, coefficients, sources, other_sources
// out: ; ao_raw, indirect_raw
kernel void stereo_slices(ARGUMENTS) {
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  real open = (real)(1);
  real3 light = make3((real)(0), (real)(0), (real)(0));
  if (ANY(!r.point.background))
    open = open_to_both(TABLES BOTH_SOURCES frame, neighbour, params, LAYERS_FROM(frame, depth),
                        OTHER_LAYERS_FROM(neighbour.frame, other_depth), r,
                        MAY_DIFFER(frame, neighbour, params.radius, r), &light);
  PUT(store, open, light, r.here)
}

// stereo_slices for the pixels of a list.
// in : depth, normal, newly_visible, other_depth; coefficients, sources, other_sources
// out: ; ao_raw, indirect_raw
kernel void stereo_slices_list(ARGUMENTS) {
  integer index;
  if (!pixels_of_item(newly_visible, frame, &index)) return;
  const Receiver r =
      receiver_at_index(frame, params.radius, params.max_reach, index, depth, normal_x, normal_y, normal_z);
  real3 light;
  const real open = open_to_both(TABLES BOTH_SOURCES frame, neighbour, params, LAYERS_FROM(frame, depth),
                                 OTHER_LAYERS_FROM(neighbour.frame, other_depth), r, EVERY_LANE, &light);
  PUT(scatter, open, light, index)
}

#endif
