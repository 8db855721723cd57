// Ambient occlusion by slices: GTAO's sampling and integral (Jimenez, Wu, Pesce, Jarabo 2016, sections 4 and 5), where the
// highest occluder closes everything below it; or with BITMASK occluders of one thickness that close what lies between their
// front and back (Therrien, Levesque, Gilet 2023). AO = 1 - mean over slices of the closed share of their cosine-weighted mass;
// slices are drawn in proportion to that mass (slice_angle.h), so that one slice a pixel is the integral over all on average.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
//      other_depth  of the other eye (gtao_stereo); both depths with the sign of visibility.h
//      newly_visible  the pixels that gtao_stereo_list computes
// out: ao_raw       1 = open .. 0 = closed, unfiltered; 1 on background
//      bent_normal  unit, view space (WITH_BENT_NORMAL); zero on background
//      cone         cosine of the half angle of the open cone about it (WITH_CONE)
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
#if STEREO
#include "shared/stereo/estimate.h"
#include "shared/stereo/passes.h"
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

static inline Side side_of(Slice slice, Search search, real sign) {
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

// Samples both sides of a slice.
static inline __attribute__((always_inline)) void search_slice(Frame frame, Params params, DepthLayers layers,
                                                               Search search, Slice slice, int within, Side* right,
                                                               Side* left) {
  const Receiver r = search.receiver;
  for (int k = 0; k < STEPS; ++k) {
    samples_of_step(frame, params.bias, r, slice, within, k, &right->sample, &left->sample);
    look(frame, params, layers, search, r.here, right->sample.place, right->sample.in_frame, (mask)(0), right);
    look(frame, params, layers, search, r.here, left->sample.place, left->sample.in_frame, (mask)(0), left);
  }
}

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

#if WITH_OPEN_DIRECTIONS
#define BENT_STEPS 32
// Takes away the closed directions on one side, in steps of the angle to the line to the eye. `inverse_density`: of the slice
// (draw_slice).
static inline void take_closed_side(OpenDirections* open, Search search, Slice slice, real inverse_density, Side side,
                                    real sign) {
  const real wedge = inverse_density * (scalar)(3.14159265358979 * 3.14159265358979 / (BENT_STEPS * DIRECTIONS));
  // Half a step, pi / 64, then whole ones, pi / 32.
  scalar cosine = (scalar)0.9987954562, sine = (scalar)0.0490676743;
  for (int k = 0; k < BENT_STEPS; ++k) {
    // Elevation above the tangent.
    const real up = cosine * slice.cosine + sign * sine * slice.sine;
    const real along = sine * slice.cosine - sign * cosine * slice.sine;
#if BITMASK
    const natural sector = to_natural(to_integer(sectors_below(along, larger(up, (real)(0)), side.scale)));
    const mask is_closed = to_mask(((side.closed.covered >> sector) & 1u) != 0u) & (up > 0);
#else
    const mask is_closed = (along > side.closed.horizon * up) & (up > 0);
#endif
    const real3 v = search.surface.to_eye, t = slice.tangent;
    const real across = sign * sine;
    add_open(open, make3(v.x * cosine + t.x * across, v.y * cosine + t.y * across, v.z * cosine + t.z * across),
             choose(is_closed, -wedge * sine, (real)(0)));
    const scalar next = cosine * (scalar)0.9951847267 - sine * (scalar)0.0980171403;
    sine = sine * (scalar)0.9951847267 + cosine * (scalar)0.0980171403;
    cosine = next;
  }
}
#endif

static inline __attribute__((always_inline)) real open_share(Frame frame, Params params, DepthLayers layers,
                                                             Search search, int within, OpenDirections* directions) {
  const Receiver r = search.receiver;
  real all_closed = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    real cosine, sine;
    const real inverse_density = draw_slice(r.point, search.surface, (scalar)d + r.noise.turn, &cosine, &sine);
    const Slice slice = slice_at(r.point, search.surface, cosine, sine);
    Side right = side_of(slice, search, (real)(1)), left = side_of(slice, search, (real)(-1));
    search_slice(frame, params, layers, search, slice, within, &right, &left);
    const real importance = inverse_density * slice.weight;
    const real closed_right = importance * closed_side(params, slice, slice.sine, &right);
    const real closed_left = importance * closed_side(params, slice, -slice.sine, &left);
    all_closed += closed_right + closed_left;
#if WITH_OPEN_DIRECTIONS
    take_closed_side(directions, search, slice, inverse_density, right, (real)(1));
    take_closed_side(directions, search, slice, inverse_density, left, (real)(-1));
#endif
  }
  return 1 - all_closed * (scalar)(1.0f / DIRECTIONS);
}

kernel void gtao_estimate(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                          OCCLUDERS_ARGUMENT WANTED_ARGUMENT PLANE_OUT ao_raw OPEN_DIRECTIONS_ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here); STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections directions = whole_hemisphere(r.normal);
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
// One slice as one eye sees it. Each eye measures its samples in a slice of its own, drawn from the same even angle about its own
// line to the point. Moved into the other eye's slice they would lie beside it, and the eyes would agree less.
typedef struct {
  Slice slice;
  real importance;  // inverse density * weight
  Side right, left;
} View;

static inline void start_view(View* view, Search search, real turn) {
  real cosine, sine;
  const real inverse_density = draw_slice(search.receiver.point, search.surface, turn, &cosine, &sine);
  view->slice = slice_at(search.receiver.point, search.surface, cosine, sine);
  view->importance = inverse_density * view->slice.weight;
  view->right = side_of(view->slice, search, (real)(1));
  view->left = side_of(view->slice, search, (real)(-1));
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
  const real of_larger = choose(own_alone > other_alone, own->importance,
                                choose(own_alone < other_alone, other->importance, mean));
  return of_larger * by_one + (scalar)0.5 * (own->importance * more_by_own + other->importance * more_by_other);
}

// `there`: the point as the other eye shows it, valid where `is_seen`.
static inline __attribute__((always_inline)) real share_open_to_both(Frame frame, Frame other, Params params,
                                                                     DepthLayers layers, DepthLayers other_layers,
                                                                     Search here, Search there, mask is_seen,
                                                                     int within) {
  real all_closed = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    const real turn = (scalar)d + here.receiver.noise.turn;
    View own, others;
    start_view(&own, here, turn);
    start_view(&others, there, turn);
    search_view(frame, params, layers, here, EVERY_LANE, is_seen, within, &own);
    if (ANY(is_seen)) search_view(other, params, other_layers, there, is_seen, is_seen, within, &others);
    all_closed += closed_by_both(&own, &others, own.slice.sine, others.slice.sine, &own.right, &others.right) +
                  closed_by_both(&own, &others, -own.slice.sine, -others.slice.sine, &own.left, &others.left);
  }
  return 1 - all_closed * (scalar)(1.0f / DIRECTIONS);
}

// AO of one point per lane. `may_differ`: lanes that use the other eye.
static inline real open_to_both(Frame frame, Neighbour neighbour, Params params, DepthLayers layers,
                                DepthLayers other_layers, Receiver receiver, mask may_differ) {
  const Frame other = neighbour.frame;
  mask is_seen;
  Receiver receiver_of_other =
      receiver_there(frame, neighbour, params.radius, params.max_reach, receiver, may_differ, &is_seen);
  receiver_of_other.noise = receiver.noise;
  const Search here = search_of(params, receiver), there = search_of(params, receiver_of_other);
  real open;
  if (frame.pitch < SHORT_PITCH &&
      reaches_only_inside(frame, receiver.point, longer(receiver.reach, here.surface.length)) &&
      reaches_only_inside(other, receiver_of_other.point, longer(receiver_of_other.reach, there.surface.length)))
    open = share_open_to_both(frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_INSIDE);
  else
    open = share_open_to_both(frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_CLAMPED);
  return choose(receiver.point.background, (real)(1), smaller(larger(open, (real)(0)), (real)(1)));
}

kernel void gtao_stereo(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x, PLANE normal_y,
                        PLANE normal_z, PLANE other_depth, HALF_OCCLUDED_ARGUMENT PLANE_OUT ao_raw) {
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  real open = (real)(1);
  if (ANY(!r.point.background))
    open = open_to_both(frame, neighbour, params, LAYERS_FROM(frame, depth),
                        OTHER_LAYERS_FROM(neighbour.frame, other_depth), r,
                        MAY_DIFFER(frame, neighbour, params.radius, r));
  store(open, ao_raw, r.here);
}

// gtao_stereo for the pixels of a list.
kernel void gtao_stereo_list(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x,
                             PLANE normal_y, PLANE normal_z, PIXEL_LIST newly_visible, PLANE other_depth,
                             PLANE_OUT ao_raw) {
  integer index;
  if (!pixels_of_item(newly_visible, frame, &index)) return;
  const Receiver r =
      receiver_at_index(frame, params.radius, params.max_reach, index, depth, normal_x, normal_y, normal_z);
  scatter(open_to_both(frame, neighbour, params, LAYERS_FROM(frame, depth),
                       OTHER_LAYERS_FROM(neighbour.frame, other_depth), r, EVERY_LANE),
          ao_raw, index);
}
#endif
