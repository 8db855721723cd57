// The search of a pixel's slices for what closes them: horizons (GTAO) or sectors (BITMASK), over one or many layers of depth, for one
// eye or two. With LIGHT also for the light that comes from what closes a sector first (light.h).
// -D DIRECTIONS, STEPS, BITMASK, FADE, THICKNESS_HEURISTIC, STOCHASTIC, EARLY_OUT, COMPENSATED, STEREO, LIGHT
#ifndef GLOAM_CLOSED_SLICES_H
#define GLOAM_CLOSED_SLICES_H

#include "estimators/arc.h"
#include "estimators/bent_normal.h"
#include "estimators/sectors.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/slice_steps.h"

#if LIGHT
#include "gtao/light.h"
#else
#define SOURCE_AT(place, by_both) place
#define SOURCE_BEHIND(frame, place, layer) place
#endif
#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif

// What is the same for all slices of a row of pixels.
typedef struct {
  Receiver receiver;
  Surface surface;
  real radius_square, thickness;  // units of the pixel's depth
#if LIGHT
  LightSources sources;
#endif
} Search;

static inline Search search_of(Params params, Receiver r) {
  Search search;
  search.receiver = r;
  search.surface = surface_at(r.point, r.normal);
  const real radius = (scalar)params.radius * r.point.inverse_depth;
  // Capped so that background is out of reach of an infinite radius too.
  search.radius_square = smaller(radius * radius, (real)(FARTHEST));
#if BITMASK
  search.thickness = (scalar)params.thickness * radius;
#else
  search.thickness = 0;
#endif
  return search;
}

// The closed part of one side of a slice.
typedef struct {
  Horizon horizon;  // of occluders that reach down to the tangent (arc.h)
  natural covered;  // sectors of the other occluders (sectors.h)
} Closed;

// One side of a slice.
typedef struct {
  SliceSample sample;
  real slope, above_e;              // slice.h
  real deeper_along, deeper_above;  // from the front of an occluder to its back
  Scale scale;
#if LIGHT
  LightRay rays[RAYS];
#endif
  Closed closed;           // with two eyes: by surfaces that this eye alone sees
  Closed closed_by_depth;  // by the first layer alone (COMPENSATED)
#if STEREO
  Closed closed_for_both;  // by surfaces that both eyes see
#endif
} Side;

static inline Side side_of(Slice slice, Search search, scalar sign) {
  Side s;
  s.slope = sign * slice.slope;
  s.above_e = slice.above_e;
  s.deeper_along = sign * slice.sine * search.thickness;
  s.deeper_above = -slice.cosine * search.thickness;
  s.scale = scale_of(slice.cosine, sign * slice.sine, slice.mass, search.receiver.noise.shift);
  s.closed.horizon = no_horizon();
  s.closed.covered = (natural)(0u);
  s.closed_by_depth = s.closed;
#if STEREO
  s.closed_for_both = s.closed;
#endif
  return s;
}

// `source`: what the point sends, as follow (light.h) has it.
static inline void take_point(Closed* closed, Side* side, Params params, Search search, real along, real above,
                              real square, mask in_frame, integer source) {
  MAY_FUSE
  const mask counts = in_frame & (square < search.radius_square) & (above > side->sample.least);
#if BITMASK
  // An occluder that reaches down to the tangent only raises the horizon, which is cheap; few float above it.
  const real back = above + side->deeper_above;
  const mask floats = counts & (back > 0);
  raise(&closed->horizon, along, above, counts & (back <= 0));
  if (ANY(floats)) {
    const real low = sectors_below(along + side->deeper_along, back, side->scale);
    const natural covered = sectors_between(low, sectors_below(along, above, side->scale));
    closed->covered |= covered & bits_of(floats);
  }
#if LIGHT
  const real distance = square * search.receiver.depth * search.receiver.depth;
#define FOLLOW(k) follow(&side->rays[k], along, above, along + side->deeper_along, back, distance, counts, source);
  FOR_EACH_RAY(FOLLOW)
#undef FOLLOW
#endif
#else
  real height = above;
#if FADE
  height *= smaller((1 - square * search.receiver.reach.inverse_square) / params.fade, (real)(1));
#endif
#if THICKNESS_HEURISTIC
  raise_or_lower(&closed->horizon, along, height, params.thickness_heuristic, counts);
#else
  raise(&closed->horizon, along, height, counts);
#endif
#endif
}

// Takes the occluder at a side's offset and this depth. Returns where further layers are needed.
static inline __attribute__((always_inline)) mask take_depth(Frame frame, Params params, Search search, Side* side,
                                                             real depth, mask counts, integer source, Closed* closed) {
  const real e = any_relative_depth(search.receiver.point, search.receiver.depth, depth);
  SlicePoint p;
  point_in_slice(frame, side->sample, side->slope, side->above_e, e, &p);
  take_point(closed, side, params, search, p.along, p.above, p.square, counts, source);
  return counts & asks_behind(search.receiver, p.above > side->sample.least, e < 0, p.square >= search.radius_square);
}

// Takes every layer at an index from `here`. `is_shared`: where both eyes see the point (STEREO).
static inline __attribute__((always_inline)) void look(Frame frame, Params params, DepthLayers layers, Search search,
                                                       int here, integer place, mask in_frame, mask is_shared,
                                                       Side* side) {
  const Receiver r = search.receiver;
#if GATHERS_ONLY
  side->closed.horizon.along = smaller(side->closed.horizon.along, sum_of_depths(layers, frame, here, place, r.farthest));
  return;
#endif
  mask by_both;
  const real depth = depth_seen(gather(layers.first + here, place), &by_both);
#if STEREO
  by_both &= is_shared;
  take_depth(frame, params, search, side, depth, in_frame & by_both, SOURCE_AT(place, 1), &side->closed_for_both);
  in_frame &= !by_both;
#endif
  const mask asked = take_depth(frame, params, search, side, depth, in_frame, SOURCE_AT(place, 0), &side->closed);
#if COMPENSATED
  take_depth(frame, params, search, side, depth, in_frame, SOURCE_AT(place, 0), &side->closed_by_depth);
#endif
  FOR_DEPTHS_BEHIND(behind, layers, frame, here, place, asked, r.farthest) {
    take_depth(frame, params, search, side, behind.next, behind.counts, SOURCE_BEHIND(frame, place, layer),
               &side->closed);
  }
}

#include "shared/sampling/slice_search.h"

// The part of a slice's mass that is closed on one side: sectors, or a share.
#if BITMASK
typedef natural Taken;
#else
typedef real Taken;
#endif

// `sine`: of the normal's lean towards this side. The horizon is turned into sectors.
static inline Taken taken_of(Slice slice, real sine, Scale scale, Closed* closed) {
#if BITMASK
  closed->covered |= sectors_between((real)(0), sectors_below_horizon(cotangent_of(closed->horizon), scale));
  return closed->covered;
#else
  return share_below(cotangent_of(closed->horizon), slice.cosine, sine, slice.mass);
#endif
}

static inline real share_of(Taken taken) {
#if BITMASK
  return count_of(taken) * (1 / SECTORS);
#else
  return taken;
#endif
}

static inline real closed_share(Slice slice, real sine, Scale scale, Closed* closed) {
  return share_of(taken_of(slice, sine, scale, closed));
}

static inline real closed_side(Params params, Slice slice, real sine, Side* side) {
  const real all = closed_share(slice, sine, side->scale, &side->closed);
  return COMPENSATE(params, all, closed_share(slice, sine, side->scale, &side->closed_by_depth));
}

// How far a direction on a side is closed, 0 to 1; `along` the tangent and `up` from it.
static inline real closed_towards(const Side* side, real along, real up) {
#if BITMASK
  const natural sector = to_natural(to_integer(sectors_below(along, larger(up, (real)(0)), side->scale)));
  const mask is_closed = to_mask(((side->closed.covered >> sector) & 1u) != 0u);
#else
  const mask is_closed = along * side->closed.horizon.above > side->closed.horizon.along * up;
#endif
  return choose(is_closed, (real)(1), (real)(0));
}
#include "shared/sampling/slice_directions.h"

#if LIGHT
// Adds the light of a side's rays. `sign`: of the side.
static inline void add_light_of_side(real3* light, real importance, Search search, Slice slice, scalar sign,
                                     const Side* side) {
  const SideAxes axes = axes_of_side(slice, search.surface.to_eye, sign);
#define ADD(k) add_light(light, importance, side->rays[k], search.sources, search.receiver.here, axes);
  FOR_EACH_RAY(ADD)
#undef ADD
}
#endif

// The open share of a pixel's hemisphere; adds closed directions to `directions`, and with LIGHT sets `light` to the mean radiance
// that closed ones send.
static inline __attribute__((always_inline)) real open_share(Frame frame, Params params, DepthLayers layers,
                                                             Search search, int within, OpenDirections* directions,
                                                             real3* light) {
  MAY_FUSE
  const Receiver r = search.receiver;
  real all_closed = 0;
  *light = make3((real)(0), (real)(0), (real)(0));
#if LIGHT
  const real ray_shift = shift_of_rays(to_natural(r.x), to_natural(r.y), frame.seed);
#endif
  for (int d = 0; d < DIRECTIONS; ++d) {
    real cosine, sine;
    const real inverse_density = draw_slice(r.point, search.surface, (scalar)d + r.noise.turn, &cosine, &sine);
    const Slice slice = slice_at(r.point, search.surface, cosine, sine);
    Side right = side_of(slice, search, (scalar)1), left = side_of(slice, search, (scalar)-1);
#if LIGHT
    const real shift = shift_of_slice(ray_shift, d);
    start_rays(right.rays, shift, slice.cosine, slice.sine, slice.mass);
    start_rays(left.rays, 1 - shift, slice.cosine, -slice.sine, slice.mass);
#endif
    search_slice(frame, params, layers, search, slice, within, &right, &left);
    const real importance = inverse_density * slice.weight;
    const real closed_right = importance * closed_side(params, slice, slice.sine, &right);
    const real closed_left = importance * closed_side(params, slice, -slice.sine, &left);
    all_closed += closed_right + closed_left;
#if LIGHT
    add_light_of_side(light, importance * (scalar)(1.0f / DIRECTIONS), search, slice, (scalar)1, &right);
    add_light_of_side(light, importance * (scalar)(1.0f / DIRECTIONS), search, slice, (scalar)-1, &left);
#endif
#if WITH_OPEN_DIRECTIONS
    take_closed_side(directions, search.surface, slice, inverse_density, &right, (scalar)1);
    take_closed_side(directions, search.surface, slice, inverse_density, &left, (scalar)-1);
#endif
#if WITH_LOBE
    take_lobe(directions, search.surface, slice, inverse_density, &right, &left);
#endif
  }
  return 1 - all_closed * (scalar)(1.0f / DIRECTIONS);
}

#endif
