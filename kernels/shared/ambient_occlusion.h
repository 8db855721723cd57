// What estimates of ambient occlusion have in common: parameters, the pixel at hand, and the way out.
#ifndef GLOAM_AMBIENT_OCCLUSION_H
#define GLOAM_AMBIENT_OCCLUSION_H

#include "shared/params.h"

// Parameters of every technique that looks around a pixel.
#define REACH_PARAMS(P)                                                                              \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "reach of an occluder")                         \
  P(float, max_reach, 0.25f, 0, 1, "image widths", "cap on the radius on the screen")                \
  P(choice, outside, border, (border, open),                                                         \
    "what lies beyond the border of the image: the surface at the border, or nothing that occludes") \
  P(bool, jitter, on, "turn and shift the samples from pixel to pixel")

// Those of every technique that looks at stochastic depths behind the depth (Vermeer, Scandolo, Eisemann 2021).
#define STOCHASTIC_PARAMS(P)                                                                                       \
  P(int, samples, 4, 1, 16, "", "stochastic depths per pixel")                                                     \
  P(choice, early_out, below, (off, below, on),                                                                    \
    "where they are not looked at: nowhere; where the depth lies below the surface, since what is behind it lies " \
    "lower; on: nor where it is within reach, as in the paper")                                                    \
  P(float, compensation, 1, 0, 8, "", "factor on what they take away: they miss some of what is hidden")

#ifdef __OPENCL_VERSION__
#include "shared/camera.h"
#include "shared/sample.h"

// Where occluders are looked for: the depth alone, every layer of a stack whose first is the depth, or with STOCHASTIC the
// depth and then every layer of a stack. A kernel's arguments after the normal:
//   OCCLUDERS_ARGUMENT PLANE_OUT ao_raw ...
// and its first line: const DepthLayers layers = LAYERS_FROM(frame, depth);
typedef struct {
  global const float* first;
  global const float* further;  // one after another (load.h)
} DepthLayers;

static inline DepthLayers depth_layers(global const float* first, global const float* further) {
  DepthLayers layers;
  layers.first = first;
  layers.further = further;
  return layers;
}

#ifdef OCCLUDERS_LAYERS
#define OCCLUDERS_ARGUMENT PLANE occluders,
#if STOCHASTIC
#define LAYERS (1 + OCCLUDERS_LAYERS)
#define LAYERS_FROM(frame, depth) depth_layers(depth, occluders)
#else
#define LAYERS OCCLUDERS_LAYERS
#define LAYERS_FROM(frame, depth) depth_layers(occluders, layer_of(occluders, frame, 1))
#endif
#else
#define LAYERS 1
#define OCCLUDERS_ARGUMENT
#define LAYERS_FROM(frame, depth) depth_layers(depth, depth)
#endif

static inline global const float* layer_at(DepthLayers layers, Frame f, int layer) {
  return layer == 0 ? layers.first : layer_of(layers.further, f, layer - 1);
}

// Where layers behind the first are asked (section 3.3): 0 everywhere; 1 where the first rises above the surface, or above
// the horizon so far, since what is behind it lies lower; 2 where it is nearer to the eye than the pixel's point, and out of
// reach.
#ifndef EARLY_OUT
#define EARLY_OUT 0
#endif

static inline mask asks_further(mask rises, mask nearer, mask out_of_reach) {
#if EARLY_OUT == 2
  return nearer & out_of_reach;
#elif EARLY_OUT == 1
  return rises;
#else
  return EVERY_LANE;
#endif
}

// What layers take together, where what further ones add to the first counts by a factor: they miss some of what is hidden
// (section 4).
#if COMPENSATED
#define COMPENSATE(params, all, by_first) ((by_first) + (params).compensation * ((all) - (by_first)))
#else
#define COMPENSATE(params, all, by_first) (all)
#endif

// The row of pixels that a work-item computes.
typedef struct {
  integer x;
  int y, here;
  real depth;
  real3 normal;
  Anchor point;
  Reach reach;
  Noise noise;
} Receiver;

static inline Receiver receiver_at(Frame frame, scalar radius, scalar max_reach, PLANE depth, PLANE normal_x,
                                   PLANE normal_y, PLANE normal_z) {
  Receiver r;
  r.y = ROW_Y;
  r.x = FIRST_X + IOTA;
  r.here = index_of(frame, FIRST_X, r.y);
  r.depth = load(depth, r.here);
  r.normal = load3(normal_x, normal_y, normal_z, r.here);
  r.point = anchor_at(frame, to_real(r.x), (real)(r.y), r.depth);
  r.reach = reach_of(frame, r.point, radius, max_reach * (scalar)frame.width);
  r.noise = noise_at(r.x, r.y, frame.seed);
  return r;
}

// RESULT = CALL, with `within` as what holds for all samples up to `widest` (sample.h).
#define LOOK_AROUND(RESULT, frame, receiver, widest, CALL)           \
  if ((frame).pitch >= SHORT_PITCH) {                                \
    const int within = SAMPLES_IN_WIDE_FRAME;                        \
    RESULT = CALL;                                                   \
  } else if (reaches_only_inside(frame, (receiver).point, widest)) { \
    const int within = SAMPLES_INSIDE;                               \
    RESULT = CALL;                                                   \
  } else {                                                           \
    const int within = SAMPLES_CLAMPED;                              \
    RESULT = CALL;                                                   \
  }

// Keeps within 0 to 1, and open on background.
static inline void store_open(real open, Receiver r, PLANE_OUT ao) {
  const real kept = smaller(larger(open, (real)(0)), (real)(1));
  store(choose(r.point.background, (real)(1), kept), ao, r.here);
}

#endif
#endif
