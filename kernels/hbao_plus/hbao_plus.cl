// HBAO+: mean obscurance over directions x steps on the screen (Bavoil, Sainz 2008; NVIDIA 2016; written out in
// Vermeer, Scandolo, Eisemann 2021, Algorithm 3). AO = 1 - 2 / samples * sum of W(|v|) max(0, n.v/|v| - bias), of all
// layers at a sample the largest.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (ambient_occlusion.h); without them the depth is the only one
// out: ao_raw     1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, POWER, JITTER, NO_FALLOFF, OUTSIDE_OPEN, OCCLUDERS_LAYERS, STOCHASTIC, EARLY_OUT, COMPENSATED
#include "estimators/obscurance.h"
#include "hbao_plus/params.h"
#include "shared/fan.h"

#if STOCHASTIC
typedef SdHbaoPlusParams Params;
#else
typedef HbaoPlusParams Params;
#endif

// The largest contribution of all layers at an offset in pixels.
static inline real obscurance_near(Frame frame, Params params, DepthLayers layers, Receiver r, integer dx, integer dy,
                                   int within) {
  real largest = 0, by_first = 0;
  mask asked = EVERY_LANE;
  for (int k = 0; k < LAYERS; ++k) {
    const real depth = sample_near(layer_at(layers, frame, k), frame, r.here, within, dx, dy);
#if GATHERS_ONLY
    largest += depth;
    continue;
#endif
    const real3 v = towards_near(frame, r.point, to_real(dx), to_real(dy), relative_depth(r.point, r.depth, depth));
    const real found = obscurance(v, r.normal, params.bias, r.reach.inverse_square);
    if (k == 0) {
      largest = by_first = found;
      if (LAYERS == 1) break;
      const real above = dot3(r.normal, v), square = dot3(v, v);
      const mask rises = (above > 0) & (above * above > params.bias * params.bias * square);
      asked = asks_further(rises, v.z > 0, square * r.reach.inverse_square >= 1);
      if (EARLY_OUT && !ANY(asked)) break;
    } else {
      largest = choose(asked, larger(found, largest), largest);
    }
  }
  return COMPENSATE(params, largest, by_first);
}

// Inlined by order: called, it is 8 % slower. `occluders` has no `restrict` because oclgrind knows no inlined one.
static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, Params params, DepthLayers layers,
                                                                    Receiver r, Fan fan, int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
      const real found = obscurance_near(frame, params, layers, r, dx, dy, within);
      sum += OUTSIDE_OPEN ? choose(counts, found, (real)(0)) : found;
    }
    turn(&fan);
  }
  return sum;
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
  const real mean = sum * (params.strength * 2 / (DIRECTIONS * STEPS));
  const real open = smaller(larger(1 - mean, (real)(0)), (real)(1));
  real ao = open;
  for (int k = 1; k < POWER; ++k) ao *= open;
  store_open(ao, r, ao_raw);
}
