// Ambient occlusion by slices: GTAO's sampling and integral (Jimenez, Wu, Pesce, Jarabo 2016, sections 4 and 5), where the
// highest occluder closes everything below it; or with BITMASK occluders of one thickness that close what lies between their
// front and back (Therrien, Levesque, Gilet 2023). AO = 1 - mean over slices of the closed share of their cosine-weighted mass;
// slices are drawn in proportion to that mass (slice_angle.h), so that one slice a pixel is the integral over all on average.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
//      other_depth  of the other eye (shared/stereo/slices.h)
// out: ao_raw       1 = open .. 0 = closed, unfiltered; 1 on background
//      bent_normal  unit, view space (WITH_BENT_NORMAL); zero on background
//      cone         cosine of the half angle of the open cone about it (WITH_CONE)
//      specular_occlusion_raw  open share of the surface's lobe (WITH_SPECULAR_OCCLUSION_RAW; reads roughness); 1 on background
//      lobe_weight  of the part of the lobe that the slices hold (WITH_LOBE_WEIGHT; reads roughness); 0 on background
// -D DIRECTIONS, STEPS, BITMASK, FADE, THICKNESS_HEURISTIC, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT,
//    COMPENSATED, STEREO, ESTIMATE_MONO, WITH_HALF_OCCLUSION
#include "estimators/arc.h"
#include "estimators/bent_normal.h"
#include "estimators/sectors.h"
#include "gtao/params.h"
#include "shared/sampling/slice_steps.h"

#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif

// What is the same for all slices of a row of pixels.
typedef struct {
  Receiver receiver;
  Surface surface;
  real radius_square, thickness;  // units of the pixel's depth
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
  real horizon;     // of occluders that reach down to the tangent (arc.h)
  natural covered;  // sectors of the other occluders (sectors.h)
} Closed;

// One side of a slice.
typedef struct {
  SliceSample sample;
  real slope, above_e;              // slice.h
  real deeper_along, deeper_above;  // from the front of an occluder to its back
  Scale scale;
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
  s.closed.horizon = (real)(NO_HORIZON);
  s.closed.covered = (natural)(0u);
  s.closed_by_depth = s.closed;
#if STEREO
  s.closed_for_both = s.closed;
#endif
  return s;
}

static inline void take_point(Closed* closed, const Side* side, Params params, Search search, real along, real above,
                              real square, mask in_frame) {
  const mask counts = in_frame & (square < search.radius_square) & (above > side->sample.least);
#if BITMASK
  // An occluder that reaches down to the tangent only raises the horizon, which is cheap; few float above it.
  const real back = above + side->deeper_above;
  const mask floats = counts & (back > 0);
  closed->horizon = raised(closed->horizon, along, above, counts & (back <= 0));
  if (ANY(floats)) {
    const real low = sectors_below(along + side->deeper_along, back, side->scale);
    const natural covered = sectors_between(low, sectors_below(along, above, side->scale));
    closed->covered |= covered & bits_of(floats);
  }
#else
  real height = above;
#if FADE
  height *= smaller((1 - square * search.receiver.reach.inverse_square) / params.fade, (real)(1));
#endif
#if THICKNESS_HEURISTIC
  closed->horizon = raised_or_lowered(closed->horizon, along, height, params.thickness_heuristic, counts);
#else
  closed->horizon = raised(closed->horizon, along, height, counts);
#endif
#endif
}

// Takes the occluder at a side's offset and this depth. Returns where further layers are needed.
static inline __attribute__((always_inline)) mask take_depth(Frame frame, Params params, Search search,
                                                             const Side* side, real depth, mask counts,
                                                             Closed* closed) {
  const real e = relative_depth(search.receiver.point, search.receiver.depth, depth);
  SlicePoint p;
  point_in_slice(frame, side->sample, side->slope, side->above_e, e, &p);
  take_point(closed, side, params, search, p.along, p.above, p.square, counts);
  return counts & asks_further(p.above > side->sample.least, e < 0, p.square >= search.radius_square);
}

// Takes every layer at an index from `here`. `is_shared`: where both eyes see the point (STEREO).
static inline __attribute__((always_inline)) void look(Frame frame, Params params, DepthLayers layers, Search search,
                                                       int here, integer place, mask in_frame, mask is_shared,
                                                       Side* side) {
  const Receiver r = search.receiver;
#if GATHERS_ONLY
  side->closed.horizon = smaller(side->closed.horizon, sum_of_depths(layers, frame, here, place, r.farthest));
  return;
#endif
  mask by_both;
  const real depth = depth_seen(gather(layers.first + here, place), &by_both);
#if STEREO
  by_both &= is_shared;
  take_depth(frame, params, search, side, depth, in_frame & by_both, &side->closed_for_both);
  in_frame &= !by_both;
#endif
  const mask asked = take_depth(frame, params, search, side, depth, in_frame, &side->closed);
#if COMPENSATED
  take_depth(frame, params, search, side, depth, in_frame, &side->closed_by_depth);
#endif
  FOR_DEPTHS_BEHIND(behind, layers, frame, here, place, asked, r.farthest) {
    take_depth(frame, params, search, side, behind.next, behind.counts, &side->closed);
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
  closed->covered |= sectors_between((real)(0), sectors_below_horizon(closed->horizon, scale));
  return closed->covered;
#else
  return share_below(closed->horizon, slice.cosine, sine, slice.mass);
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
  const mask is_closed = along > side->closed.horizon * up;
#endif
  return choose(is_closed, (real)(1), (real)(0));
}
#include "shared/sampling/slice_directions.h"

static inline __attribute__((always_inline)) real open_share(Frame frame, Params params, DepthLayers layers,
                                                             Search search, int within, OpenDirections* directions) {
  const Receiver r = search.receiver;
  real all_closed = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    real cosine, sine;
    const real inverse_density = draw_slice(r.point, search.surface, (scalar)d + r.noise.turn, &cosine, &sine);
    const Slice slice = slice_at(r.point, search.surface, cosine, sine);
    Side right = side_of(slice, search, (scalar)1), left = side_of(slice, search, (scalar)-1);
    search_slice(frame, params, layers, search, slice, within, &right, &left);
    const real importance = inverse_density * slice.weight;
    const real closed_right = importance * closed_side(params, slice, slice.sine, &right);
    const real closed_left = importance * closed_side(params, slice, -slice.sine, &left);
    all_closed += closed_right + closed_left;
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

kernel void gtao_estimate(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                          OCCLUDERS_ARGUMENT ROUGHNESS_ARGUMENT WANTED_ARGUMENT PLANE_OUT ao_raw
                              OPEN_DIRECTIONS_ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here); STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections directions = whole_hemisphere(r.normal);
  SET_LOBE(directions, r)
  real open = 1;
  if (ANY(!r.point.background)) {
    const Search search = search_of(params, r);
    // A slice that is not parallel to the image plane reaches further on the screen than the radius at the pixel's depth.
    const Reach widest = longer(r.reach, search.surface.length);
    LOOK_AROUND(open, frame, r, widest, open_share(frame, params, layers, search, within, &directions))
  }
  store_open(open, r, ao_raw);
  STORE_OPEN_DIRECTIONS(directions, r)
}

#if STEREO
#include "shared/stereo/slice_view.h"

static inline Taken taken_by_either(Taken a, Taken b) {
#if BITMASK
  return a | b;
#else
  return larger(a, b);
#endif
}

// A surface that both eyes see closes each eye's slice as that eye sees it, and the mean of both counts; a surface that one eye
// alone sees closes both, and counts as in the slice of the eye that it closes more of. Section 3.1 combines obscurance sample by
// sample. Horizons combined so are too low, as two samples rarely meet the highest occluder alike; sectors of one eye alone are
// noisier.
static inline real closed_by_both(View* own, View* other, real sine, real other_sine, Side* side, Side* other_side) {
  const Taken by_own_alone = taken_of(own->slice, sine, side->scale, &side->closed);
  const Taken by_other_alone = taken_of(other->slice, other_sine, other_side->scale, &other_side->closed);
  const Taken alone = taken_by_either(by_own_alone, by_other_alone);
  const real own_alone = share_of(by_own_alone), other_alone = share_of(by_other_alone), by_one = share_of(alone);
  const Taken by_own = taken_of(own->slice, sine, side->scale, &side->closed_for_both);
  const Taken by_other = taken_of(other->slice, other_sine, other_side->scale, &other_side->closed_for_both);
  const real more_by_own = share_of(taken_by_either(by_own, alone)) - by_one;
  const real more_by_other = share_of(taken_by_either(by_other, alone)) - by_one;
  const real mean = (scalar)0.5 * (own->importance + other->importance);
  const real of_larger =
      choose(own_alone > other_alone, own->importance, choose(own_alone < other_alone, other->importance, mean));
  return of_larger * by_one + (scalar)0.5 * (own->importance * more_by_own + other->importance * more_by_other);
}

// Both sides of a slice, times its importance.
static inline real closed_to_both(Search here, Search there, View* own, View* other, mask is_seen) {
  return closed_by_both(own, other, own->slice.sine, other->slice.sine, &own->right, &other->right) +
         closed_by_both(own, other, -own->slice.sine, -other->slice.sine, &own->left, &other->left);
}

#include "shared/stereo/slices.h"
#endif
