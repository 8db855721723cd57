// HBAO+: mean obscurance over directions x steps on the screen (Bavoil, Sainz 2008; NVIDIA 2016; written out in
// Vermeer, Scandolo, Eisemann 2021, Algorithm 3). AO = 1 - 2 / samples * sum of W(|v|) max(0, n.v/|v| - bias), of all
// layers at a sample the largest.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  stack of depth layers, in any order; without it the depth is the only layer
// out: ao_raw     1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, POWER, JITTER, NO_FALLOFF, OCCLUDERS_LAYERS
#include "estimators/obscurance.h"
#include "hbao_plus/params.h"
#include "shared/sample.h"

#ifdef OCCLUDERS_LAYERS
#define LAYERS OCCLUDERS_LAYERS
#else
#define LAYERS 1
#endif

// Where a pixel looks.
typedef struct {
  real cosine, sine;        // of the first direction
  real stride_x, stride_y;  // from step to step, pixels
  real shift;               // of the steps, 0 to 1
} Fan;

// The largest contribution of all layers at an offset in pixels.
static inline real obscurance_near(Frame frame, HbaoPlusParams params, global const float* occluders, int here,
                                   Anchor point, real z, real3 n, integer dx, integer dy, real inverse_square,
                                   int within) {
  real largest = 0;
  for (int k = 0; k < LAYERS; ++k) {
    const real depth = sample_near(layer_of(occluders, frame, k), frame, here, within, dx, dy);
    const real3 v = towards_near(frame, point, to_real(dx), to_real(dy), relative_depth(point, z, depth));
    const real found = obscurance(v, n, params.bias, inverse_square);
    largest = k == 0 ? found : larger(found, largest);
  }
  return largest;
}

// Inlined by order: called, it is 8 % slower. `occluders` has no `restrict` because oclgrind knows no inlined one.
static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, HbaoPlusParams params,
                                                                    global const float* occluders, integer x, int y,
                                                                    int here, Anchor point, real z, real3 n, Fan fan,
                                                                    real inverse_square, int within) {
  real cosine = fan.cosine, sine = fan.sine, turn_cosine, turn_sine, sum = 0;
  cosine_sine_of_turns((real)((scalar)1 / DIRECTIONS), &turn_cosine, &turn_sine);
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      // From one pixel away to the radius.
      integer dx = nearest(cosine * (1 + (fan.shift + k) * fan.stride_x));
      integer dy = nearest(sine * (1 + (fan.shift + k) * fan.stride_y));
      keep_in_frame(frame, x, y, within, &dx, &dy);
      sum += obscurance_near(frame, params, occluders, here, point, z, n, dx, dy, inverse_square, within);
    }
    const real next = cosine * turn_cosine - sine * turn_sine;
    sine = sine * turn_cosine + cosine * turn_sine;
    cosine = next;
  }
  return sum;
}

kernel void hbao_plus_estimate(Frame frame, HbaoPlusParams params, PLANE depth, PLANE normal_x, PLANE normal_y,
                               PLANE normal_z,
#ifdef OCCLUDERS_LAYERS
                               PLANE occluders,
#endif
                               PLANE_OUT ao_raw) {
#ifndef OCCLUDERS_LAYERS
  PLANE occluders = depth;
#endif
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here);
  if (!ANY(!is_background(z))) {
    store((real)(1), ao_raw, here);
    return;
  }
  const real3 n = load3(normal_x, normal_y, normal_z, here);
  const Anchor point = anchor_at(frame, to_real(x), (real)(y), z);
  const Reach reach = reach_of(point, params.radius, params.max_pixels);

  Fan fan;
#if JITTER
  const natural h = pixel_hash(x, y, frame.seed);
  const real turn = unit_random(h) * (scalar)(1.0f / DIRECTIONS);
  fan.shift = unit_random(hash(h + 1));
#else
  const real turn = 0;
  fan.shift = (scalar)0.5;
#endif
  cosine_sine_of_turns(turn, &fan.cosine, &fan.sine);
  fan.stride_x = larger(reach.pixels_x - 1, (real)(0)) * (scalar)(1.0f / STEPS);
  fan.stride_y = larger(reach.pixels_y - 1, (real)(0)) * (scalar)(1.0f / STEPS);

  real sum;
#define SUM_OF_OBSCURANCE(within) \
  sum_of_obscurance(frame, params, occluders, x, y, here, point, z, n, fan, reach.inverse_square, within)
  if (frame.pitch >= SHORT_PITCH) {
    sum = SUM_OF_OBSCURANCE(SAMPLES_IN_WIDE_FRAME);
  } else if (reaches_only_inside(frame, point, reach)) {
    sum = SUM_OF_OBSCURANCE(SAMPLES_INSIDE);
  } else {
    sum = SUM_OF_OBSCURANCE(SAMPLES_CLAMPED);
  }
  const real open = smaller(larger(1 - sum * (params.strength * 2 / (DIRECTIONS * STEPS)), (real)(0)), (real)(1));
  real ao = open;
  for (int k = 1; k < POWER; ++k) ao *= open;
  store(choose(point.background, (real)(1), ao), ao_raw, here);
}
