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

#ifdef __OPENCL_VERSION__
#include "shared/camera.h"
#include "shared/sample.h"

// Occluders: every layer of a stack, or the depth alone. A kernel's arguments after the normal:
//   OCCLUDERS_ARGUMENT PLANE_OUT ao_raw ...
// and its first line: OCCLUDERS_FROM(depth)
#ifdef OCCLUDERS_LAYERS
#define LAYERS OCCLUDERS_LAYERS
#define OCCLUDERS_ARGUMENT PLANE occluders,
#define OCCLUDERS_FROM(depth)
#else
#define LAYERS 1
#define OCCLUDERS_ARGUMENT
#define OCCLUDERS_FROM(depth) PLANE occluders = depth;
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
