// HBAO+: mean obscurance over directions x steps on the screen (Bavoil, Sainz 2008; NVIDIA 2016; written out in
// Vermeer, Scandolo, Eisemann 2021, Algorithm 3). AO = 1 - 2 / samples * sum of W(|v|) max(0, n.v/|v| - bias), of all
// layers at a sample the largest.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (ambient_occlusion.h); without them the depth is the only one
//      other_depth, occluders  of the other view, at a resolution of their own (hbao_plus_other_view)
//      own        what hbao_plus_estimate found
// out: ao_raw     1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, POWER, JITTER, NO_FALLOFF, OUTSIDE_OPEN, OCCLUDERS_LAYERS, STOCHASTIC, EARLY_OUT, COMPENSATED, MULTIVIEW
#include "estimators/obscurance.h"
#include "hbao_plus/params.h"
#include "shared/fan.h"

#if MULTIVIEW
#include "shared/neighbour.h"
#endif
#if MULTIVIEW
typedef MultiviewParams Params;
#elif STOCHASTIC
typedef SdHbaoPlusParams Params;
#else
typedef HbaoPlusParams Params;
#endif
#if STOCHASTIC
#include "shared/hidden_depths.h"
#endif

// The largest contribution of all layers at an index from `here`, which lies (dx, dy) pixels from the point.
static inline __attribute__((always_inline)) real obscurance_at(Frame frame, Params params, DepthLayers layers,
                                                                Receiver r, real dx, real dy, int here, integer place) {
#if GATHERS_ONLY
  return sum_of_depths(layers, frame, here, place, r.farthest);
#endif
  const real depth = gather(layers.first + here, place);
  const real3 v = towards_near(frame, r.point, dx, dy, relative_depth(r.point, r.depth, depth));
  const real by_first = obscurance(v, r.normal, params.bias, r.reach.inverse_square);
  const mask rises = fused_dot3(r.normal, v) > params.bias * least_distance(r, dx, dy);
  const mask asked = asks_further(rises, v.z > 0, square_of(v) * r.reach.inverse_square >= 1);
  real largest = by_first;
  Behind behind;
#pragma unroll 4
  for (int k = 0; k < LAYERS - 1; ++k) {
    if (!look_behind(layers, frame, k, here, place, asked, r.farthest, &behind)) break;
    const real3 w = towards_near(frame, r.point, dx, dy, relative_depth(r.point, r.depth, behind.next));
    largest =
        choose(behind.counts, larger(obscurance(w, r.normal, params.bias, r.reach.inverse_square), largest), largest);
  }
  return COMPENSATE(params, largest, by_first);
}

// Inlined by order: called, it is 8 % slower.
static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, Params params, DepthLayers layers,
                                                                    Receiver r, Fan fan, int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
      const real found = obscurance_at(frame, params, layers, r, to_real(dx), to_real(dy), r.here,
                                       index_within(frame, within, dx, dy));
      sum += OUTSIDE_OPEN ? choose(counts, found, (real)(0)) : found;
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

kernel void hbao_plus_estimate(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                               OCCLUDERS_ARGUMENT PLANE_OUT ao_raw) {
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  if (!ANY(!r.point.background)) {
    store((real)(1), ao_raw, r.here);
    return;
  }
  const Fan fan = fan_of(r.reach, r.noise);
  real sum;
  LOOK_AROUND(sum, frame, r, r.reach, sum_of_obscurance(frame, params, layers, r, fan, within))
  store_open(open_of(params, sum), r, ao_raw);
}

#if MULTIVIEW
// The same around the pixel's point as the other view sees it.
static inline real sum_around(Frame other, Params params, DepthLayers layers, Receiver r, Fan fan) {
  const integer column = nearest(r.point.x), row = nearest(r.point.y);
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      const integer x = clamp(column + dx, (integer)(0), (integer)(other.width - 1));
      const integer y = clamp(row + dy, (integer)(0), (integer)(other.height - 1));
      const real found = obscurance_at(other, params, layers, r, to_real(x) - r.point.x, to_real(y) - r.point.y,
                                       FRAME_GUARD, y * other.pitch + x);
      // At the border a sample may come down to the point's own pixel, of which only rounding is left.
      mask counts = to_mask((x != column) | (y != row));
      if (OUTSIDE_OPEN) counts &= to_mask((x == column + dx) & (y == row + dy));
      sum += choose(counts, found, (real)(0));
    }
    turn(&fan);
  }
  return sum;
}

// Algorithm 3: of both views the one that occludes more.
kernel void hbao_plus_other_view(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x,
                                 PLANE normal_y, PLANE normal_z, PLANE own, PLANE other_depth, PLANE occluders,
                                 PLANE_OUT ao_raw) {
  const Frame other = neighbour.frame;
  const Receiver here = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  const Projection there =
      project_into(neighbour, position_at(frame, here.point.x, here.point.y, here.depth), !here.point.background);
  real open = load(own, here.here);
  if (ANY(there.is_seen)) {
    Receiver r = here;
    r.depth = there.depth;
    r.normal = rotated(neighbour, here.normal);
    r.point = anchor_at(other, there.x, there.y, there.depth);
    r.reach = reach_of(other, r.point, params.radius, params.max_reach * (scalar)other.width);
    expect_behind(&r, other, params.radius);
    const real sum = sum_around(other, params, LAYERS_FROM(other, other_depth), r, fan_of(r.reach, r.noise));
    open = choose(there.is_seen, smaller(open_of(params, sum), open), open);
  }
  store_open(open, here, ao_raw);
}
#endif
