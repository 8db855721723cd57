// HBAO+: mean obscurance over directions x steps on the screen (Bavoil, Sainz 2008; NVIDIA 2016; written out in Vermeer,
// Scandolo, Eisemann 2021, Algorithm 3). AO = 1 - 2 / samples * sum of W(|v|) max(0, n.v/|v| - bias); of all layers at a sample,
// the one that contributes most counts.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
//      other_depth, occluders  of the other view, at its own resolution (hbao_plus_other_view)
//      own        result of hbao_plus_estimate
// out: ao_raw     1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, POWER, JITTER, NO_FALLOFF, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT, COMPENSATED,
//    MULTIVIEW, STEREO, ESTIMATE_MONO, WITH_HALF_OCCLUSION
#include "estimators/obscurance.h"
#include "shared/sampling/fan.h"

#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif
#if MULTIVIEW || STEREO
#include "shared/frame/neighbour.h"
#endif
#if STEREO
#include "shared/stereo/estimate.h"
#include "shared/stereo/passes.h"
#endif

// The largest contribution of all layers at an index from `here`, which lies (dx, dy) pixels from the point. `by_both`: whether
// both eyes see the first layer (STEREO).
static inline __attribute__((always_inline)) real obscurance_at(Frame frame, Params params, DepthLayers layers,
                                                                Receiver r, real dx, real dy, int here, integer place,
                                                                mask* by_both) {
#if GATHERS_ONLY
  *by_both = (mask)(0);
  return sum_of_depths(layers, frame, here, place, r.farthest);
#endif
  const real depth = depth_seen(gather(layers.first + here, place), by_both);
  // Background has no weight, wherever infinity leads.
  const real3 v = towards_near(frame, r.point, dx, dy, any_relative_depth(r.point, r.depth, depth));
  const real by_first = obscurance(v, r.normal, params.bias, r.reach.inverse_square);
  const mask rises = fused_dot3(r.normal, v) > params.bias * least_distance(r, dx, dy);
  const mask asked = asks_behind(r, rises, v.z > 0, square_of(v) * r.reach.inverse_square >= 1);
  real largest = by_first;
  FOR_DEPTHS_BEHIND(behind, layers, frame, here, place, asked, r.farthest) {
    const real3 w = towards_depth(frame, r, dx, dy, behind.next);
    largest =
        choose(behind.counts, larger(obscurance(w, r.normal, params.bias, r.reach.inverse_square), largest), largest);
  }
  return COMPENSATE(params, largest, by_first);
}

// Always inlined: as a call it is 8 % slower.
static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, Params params, DepthLayers layers,
                                                                    Receiver r, Fan fan, int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
      mask by_both;
      const real found = obscurance_at(frame, params, layers, r, to_real(dx), to_real(dy), r.here,
                                       index_within(frame, within, dx, dy), &by_both);
      sum += counted(counts, found);
    }
    turn(&fan);
  }
  return sum;
}

static inline real open_of(Params params, real sum) {
  const real mean = sum * (params.strength * 2 / (DIRECTIONS * STEPS));
  const real open = smaller(larger(1 - mean, (real)(0)), (real)(1));
  real ao = open;
  for (int k = 1; k < POWER; ++k) ao *= open;
  return ao;
}

// in : depth, normal; occluders, wanted
// out: ao_raw
kernel void hbao_plus_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  if (!ANY(!r.point.background)) {
    store((real)(1), ao_raw, r.here);
    return;
  }
  const Fan fan = fan_of(r.reach, r.noise);
  real sum;
  LOOK_AROUND(sum, frame, r, r.reach, sum_of_obscurance(frame, params, layers, r, fan, within))
  store_open(open_of(params, sum), r, ao_raw);
}

#if MULTIVIEW || STEREO
// Obscurance of step k around a point. `within`: as for place_around.
static inline __attribute__((always_inline)) real obscurance_around(Frame f, Params params, DepthLayers layers,
                                                                    Receiver r, Centre c, Fan fan, int k, int within,
                                                                    mask* by_both) {
  integer dx, dy;
  step_at(fan, k, &dx, &dy);
  mask is_inside;
  const integer place = place_around(f, c, within, &dx, &dy, &is_inside);
  const real found = obscurance_at(f, params, layers, r, to_real(dx) + c.left, to_real(dy) + c.up, 0, place, by_both);
  if (within == SAMPLES_INSIDE) return found;
  *by_both &= is_inside;
  // At the border a sample may be clamped to the point's own pixel, which holds nothing but rounding.
  mask counts = to_mask((dx != 0) | (dy != 0));
  if (OUTSIDE_OPEN) counts &= is_inside;
  return choose(counts, found, (real)(0));
}

// Sum of obscurance in one view around a point that need not lie on a pixel centre.
static inline __attribute__((always_inline)) real sum_around(Frame f, Params params, DepthLayers layers, Receiver r,
                                                             Fan fan, int within) {
  const Centre centre = centre_of(f, r.point);
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    mask by_both;
#pragma unroll 4
    for (int k = 0; k < STEPS; ++k) sum += obscurance_around(f, params, layers, r, centre, fan, k, within, &by_both);
    turn(&fan);
  }
  return sum;
}
#endif

#if MULTIVIEW
// Algorithm 3: the result of the view that occludes more.
// in : depth, normal, own, other_depth, occluders
// out: ao_raw
kernel void hbao_plus_other_view(ARGUMENTS) {
  const Frame other = neighbour.frame;
  const Receiver here = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  const Projection there =
      project_into(neighbour, position_at(frame, here.point.x, here.point.y, here.depth), !here.point.background);
  real open = load(own, here.here);
  if (ANY(there.is_seen)) {
    const Receiver r = receiver_of(other, params.radius, params.max_reach, there.x, there.y, there.depth,
                                   rotated(neighbour, here.normal));
    const real sum =
        sum_around(other, params, LAYERS_FROM(other, other_depth), r, fan_of(r.reach, here.noise), SAMPLES_CLAMPED);
    open = choose(there.is_seen, smaller(open_of(params, sum), open), open);
  }
  store_open(open, here, ao_raw);
}
#endif

#if STEREO
// Sum over samples of what both eyes find: their mean where both see the occluder, else the larger value (section 3.1). `there`:
// the point as the other eye shows it, valid where `is_seen`.
static inline __attribute__((always_inline)) real sum_of_both(Frame frame, Frame other, Params params,
                                                              DepthLayers layers, DepthLayers other_layers,
                                                              Receiver here, Receiver there, mask is_seen, int within) {
  const Centre centre = centre_of(frame, here.point), other_centre = centre_of(other, there.point);
  Fan fan = fan_of(here.reach, here.noise), other_fan = fan_of(there.reach, here.noise);
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#if LAYERS == 1
#pragma unroll 4
#else
// As fast as unrolled, and compiles in a third less time.
#pragma unroll 1
#endif
    for (int k = 0; k < STEPS; ++k) {
      mask by_both, by_both_there;
      const real own = obscurance_around(frame, params, layers, here, centre, fan, k, within, &by_both);
      const real found =
          obscurance_around(other, params, other_layers, there, other_centre, other_fan, k, within, &by_both_there);
      const real together = choose(by_both & by_both_there, (scalar)0.5 * (own + found), larger(own, found));
      sum += choose(is_seen, together, own);
    }
    turn(&fan);
    turn(&other_fan);
  }
  return sum;
}

// AO of one point per lane. `may_differ`: lanes that use the other eye.
static inline real open_to_both(Frame frame, Neighbour neighbour, Params params, DepthLayers layers,
                                DepthLayers other_layers, Receiver here, mask may_differ) {
  const Frame other = neighbour.frame;
  mask is_seen;
  const Receiver there = receiver_there(frame, neighbour, params.radius, params.max_reach, here, may_differ, &is_seen);
  const int is_inside = !is_wide(frame) && reaches_only_inside(frame, here.point, here.reach);
  if (!ANY(is_seen)) {
    const Fan fan = fan_of(here.reach, here.noise);
    return open_of(params, is_inside ? sum_around(frame, params, layers, here, fan, SAMPLES_INSIDE)
                                     : sum_around(frame, params, layers, here, fan, SAMPLES_CLAMPED));
  }
  real sum;
  if (is_inside && reaches_only_inside(other, there.point, there.reach))
    sum = sum_of_both(frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_INSIDE);
  else
    sum = sum_of_both(frame, other, params, layers, other_layers, here, there, is_seen, SAMPLES_CLAMPED);
  return open_of(params, sum);
}

// in : depth, normal, other_depth; other_half_occluded, occluders, other_occluders
// out: ao_raw
kernel void hbao_plus_stereo(ARGUMENTS) {
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  real open = (real)(1);
  if (ANY(!r.point.background))
    open = open_to_both(frame, neighbour, params, LAYERS_FROM(frame, depth),
                        OTHER_LAYERS_FROM(neighbour.frame, other_depth), r,
                        MAY_DIFFER(frame, neighbour, params.radius, r));
  store(choose(r.point.background, (real)(1), open), ao_raw, r.here);
}

// hbao_plus_stereo for the pixels of a list.
// in : depth, normal, newly_visible, other_depth; occluders, other_occluders
// out: ao_raw
kernel void hbao_plus_stereo_list(ARGUMENTS) {
  integer index;
  if (!pixels_of_item(newly_visible, frame, &index)) return;
  const Receiver r =
      receiver_at_index(frame, params.radius, params.max_reach, index, depth, normal_x, normal_y, normal_z);
  scatter(open_to_both(frame, neighbour, params, LAYERS_FROM(frame, depth),
                       OTHER_LAYERS_FROM(neighbour.frame, other_depth), r, EVERY_LANE),
          ao_raw, index);
}
#endif
