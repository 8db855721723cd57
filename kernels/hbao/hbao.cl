// Horizon-based ambient occlusion (Bavoil, Sainz, Dimitrov 2008; written out in Vermeer, Scandolo, Eisemann 2021, Algorithm 2).
// Along each direction the horizon only rises; each rise takes W(|v|) (sin h_new - sin h_old), and AO = 1 - mean over directions
// of what was taken. Of all layers at a sample, the one that takes most counts.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
// out: ao_raw       1 = open .. 0 = closed, unfiltered; 1 on background
//      bent_normal  unit, view space (WITH_BENT_NORMAL); zero on background
//      cone         cosine of the half angle of the open cone about it (WITH_CONE)
// -D DIRECTIONS, STEPS, JITTER, NO_FALLOFF, LINEAR_FALLOFF, COSINE_WEIGHTED, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED,
//    STOCHASTIC, EARLY_OUT, COMPENSATED
#include "estimators/horizon.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/fan.h"

#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif

// Raises a horizon by the layers at an offset in pixels. Always inlined, and returns no struct: oclgrind mishandles returned
// structs here.
static inline __attribute__((always_inline)) void rise_near(Frame frame, Params params, DepthLayers layers, Receiver r,
                                                            integer dx, integer dy, mask counts, int within,
                                                            Horizon* horizon) {
  const integer place = index_within(frame, within, dx, dy);
#if GATHERS_ONLY
  horizon->taken += sum_of_depths(layers, frame, r.here, place, r.farthest);
  return;
#endif
  const real x = to_real(dx), y = to_real(dy), depth = gather(layers.first + r.here, place);
  const real3 v = towards_depth(frame, r, x, y, depth);
  Rise rise = rise_to(*horizon, v, r.normal, r.reach.inverse_square, counts);
#if COMPENSATED
  const Rise by_first = rise;
#endif
  // Bound: a height is at most its sine.
  const mask rises = fused_dot3(r.normal, v) > horizon->height * least_distance(r, x, y);
  const mask asked = counts & asks_behind(r, rises, v.z > 0, square_of(v) * r.reach.inverse_square >= 1);
  FOR_DEPTHS_BEHIND(behind, layers, frame, r.here, place, asked, r.farthest) {
    const real3 w = towards_depth(frame, r, x, y, behind.next);
    rise = greater_rise(rise, rise_to(*horizon, w, r.normal, r.reach.inverse_square, behind.counts));
  }
#if COMPENSATED
  rise = compensated_rise(*horizon, rise, by_first, params.compensation);
#endif
  raise_by(horizon, rise);
}

static inline __attribute__((always_inline)) void sweep(Frame frame, Params params, DepthLayers layers, Receiver r,
                                                        Fan fan, scalar lowest, int within, Horizon* horizon) {
  *horizon = horizon_from(lowest);
#pragma unroll 8
  for (int k = 0; k < STEPS; ++k) {
    integer dx, dy;
    step_at(fan, k, &dx, &dy);
    const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
    rise_near(frame, params, layers, r, dx, dy, counts, within, horizon);
  }
}

#if WITH_OPEN_DIRECTIONS
// Takes away the closed part of the wedge about a direction of the fan. Directions are evenly spread on the screen; a wedge is as
// wide as the direction's share of the turn about the normal.
static inline void take_closed_direction(OpenDirections* open, Receiver r, Surface surface, Fan fan, Horizon horizon,
                                         scalar lowest) {
  const Anchor p = r.point;
  const real pixel_x = (1 + fan.stride_x) * p.across_x, pixel_y = -(1 + fan.stride_y) * p.across_y;
  const real x = fan.cosine * pixel_x, y = fan.sine * pixel_y;
  const real inverse_away = (scalar)1 / surface.away;
  // Moved along the pixel's ray onto the tangent plane.
  const real e = -(surface.normal.x * x + surface.normal.y * y) * inverse_away;
  const real3 tangent = make3(x + p.ray_x * e, y + p.ray_y * e, -e);
  const real square = larger(dot3(tangent, tangent), (real)(1e-30f));
  const real width = ((scalar)6.28318530717959 / DIRECTIONS) * (pixel_x * pixel_y * inverse_away / square);
  const mask is_open = horizon.height <= lowest;
  const real sine = choose(is_open, (real)(0), SINE_OF_HEIGHT(larger(horizon.height, (real)(0))));
  take_closed_wedge(open, scale3(tangent, inverse_sqrt(square)), surface.normal, sine, width);
}
#endif

// Sum over directions of what the horizons take.
static inline __attribute__((always_inline)) real taken_around(Frame frame, Params params, DepthLayers layers,
                                                               Receiver r, Fan fan, scalar lowest, int within,
                                                               OpenDirections* directions) {
#if WITH_OPEN_DIRECTIONS
  const Surface surface = surface_at(r.point, r.normal);
#endif
  real taken = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    Horizon horizon;
    sweep(frame, params, layers, r, fan, lowest, within, &horizon);
    taken += horizon.taken;
#if WITH_OPEN_DIRECTIONS
    take_closed_direction(directions, r, surface, fan, horizon, lowest);
#endif
    turn(&fan);
  }
  return taken;
}

// The bias, an angle in radians, as a height.
static inline scalar lowest_height(Params params) {
  real cosine, sine;
  cosine_sine_of_turns((real)((scalar)params.bias * (scalar)0.15915494309189535), &cosine, &sine);
#if LANES == 1
  return HEIGHT_OF_SINE(sine);
#else
  return HEIGHT_OF_SINE(sine.s0);
#endif
}

// in : depth, normal; occluders, wanted
// out: ao_raw; bent_normal, cone
kernel void hbao_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here); STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections directions = whole_hemisphere(r.normal);
  real taken = 0;
  if (ANY(!r.point.background)) {
    const Fan fan = fan_of(r.reach, r.noise);
    const scalar lowest = lowest_height(params);
    LOOK_AROUND(taken, frame, r, r.reach, taken_around(frame, params, layers, r, fan, lowest, within, &directions))
  }
  store_open(1 - taken * (scalar)(1.0f / DIRECTIONS), r, ao_raw);
  STORE_OPEN_DIRECTIONS(directions, r)
}
