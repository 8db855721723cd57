// What estimates of ambient occlusion have in common: parameters, the pixel at hand, and the way out.
#ifndef GLOAM_AMBIENT_OCCLUSION_H
#define GLOAM_AMBIENT_OCCLUSION_H

#include "shared/lanes/params.h"

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
    "lower still; on: nor where it is within reach, as in the paper")                                              \
  P(float, compensation, 1, 0, 8, "", "factor on what they take away: they miss some of what is hidden")

#ifdef __OPENCL_VERSION__
#include "shared/frame/camera.h"
#include "shared/lanes/wanted.h"
#include "shared/sampling/sample.h"

// Where occluders are looked for: the depth alone, every layer of a stack whose first is the depth, or with STOCHASTIC the
// depth and then every layer of a stack. A kernel's arguments after the normal:
//   OCCLUDERS_ARGUMENT WANTED_ARGUMENT PLANE_OUT ao_raw ...
// and its first lines:
//   SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
//   const DepthLayers layers = LAYERS_FROM(frame, depth);
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
// Hidden depths (hidden_depths.h).
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

// The same of the other of two views.
#if OCCLUDERS_LAYERS
#define OTHER_OCCLUDERS_ARGUMENT PLANE other_occluders,
#define OTHER_LAYERS_FROM(frame, depth) depth_layers(depth, other_occluders)
#else
#define OTHER_OCCLUDERS_ARGUMENT
#define OTHER_LAYERS_FROM(frame, depth) depth_layers(depth, depth)
#endif

// A depth of the first layer. `by_both`: whether two eyes see it, where the sign of the depth says so (stereo.h).
static inline real depth_seen(real stored_depth, mask* by_both) {
#if STEREO
  *by_both = stored_depth < 0;
  return fabs(stored_depth);
#else
  *by_both = (mask)(0);
  return stored_depth;
#endif
}

static inline global const float* layer_at(DepthLayers layers, Frame f, int layer) {
  return layer == 0 ? layers.first : layer_of(layers.further, f, layer - 1);
}

// Where layers behind the first are asked (section 3.3): 0 everywhere; 1 where the first `rises` over the tangent plane so
// far that something behind it, which on a surface that faces the eye is lower, may still count, so that this changes
// nothing; 2 where moreover it is nearer to the eye than the pixel's point, and out of reach.
#ifndef EARLY_OUT
#define EARLY_OUT 0
#endif

static inline mask asks_further(mask rises, mask nearer, mask out_of_reach) {
#if EARLY_OUT == 2
  return rises & nearer & out_of_reach;
#elif EARLY_OUT == 1
  return rises;
#else
  return EVERY_LANE;
#endif
}

// Layers behind the first are read by groups: of stacks that techniques sort themselves, several lie side by side, pixel by
// pixel, front to back. Those of a frame come in any order.
#if STOCHASTIC && OCCLUDERS_LAYERS % 4 == 0
#define GROUP 4
#elif STOCHASTIC && OCCLUDERS_LAYERS % 2 == 0
#define GROUP 2
#else
#define GROUP 1
#endif

// Two depths behind the first that come at once.
typedef struct {
  real next, later;
  mask counts;  // where `next` may
} Behind;

// Brings depth `k` behind the first at an index from `here` into `behind->next`. Returns 0 if what is sorted holds nothing
// before `farthest` from there on, for none of the lanes that ask. To be called with k = 0, 1, ... in order.
static inline __attribute__((always_inline)) int look_behind(DepthLayers layers, Frame f, int k, int here,
                                                             integer index, mask asked, real farthest, Behind* behind) {
#if EARLY_OUT
  if (k == 0 && !ANY(asked)) return 0;
#endif
#if GROUP == 1
  behind->next = gather(layer_of(layers.further, f, k) + here, index);
#else
  global const float* group = layer_of(layers.further, f, k - k % GROUP) + (size_t)here * GROUP;
  if (k % 2 == 0)
    gather_pair(group, (GROUP / 2) * index + k % GROUP / 2, &behind->next, &behind->later);
  else
    behind->next = behind->later;
#endif
#if STOCHASTIC
  // Lane by lane, so that none depends on the others.
  behind->counts = asked & (behind->next < farthest);
  return ANY(behind->counts);
#else
  behind->counts = asked;
  return 1;
#endif
}

// Nothing but what is read at an index (GATHERS_ONLY).
static inline __attribute__((always_inline)) real sum_of_depths(DepthLayers layers, Frame f, int here, integer index,
                                                                real farthest) {
  real sum = gather(layers.first + here, index);
  Behind behind;
#pragma unroll 4
  for (int k = 0; k < LAYERS - 1; ++k) {
    if (!look_behind(layers, f, k, here, index, EVERY_LANE, farthest, &behind)) break;
    sum += smaller(behind.next, farthest);
  }
  return sum;
}

// Writes a group.
static inline void store_group(const real* depths, global float* layers, int here) {
#if GROUP == 1
  store(depths[0], layers, here);
#elif GROUP == 2
  store_pair(depths[0], depths[1], layers, here);
#else
  store_four(depths[0], depths[1], depths[2], depths[3], layers, here);
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
  real farthest;          // depth from which on nothing is within the radius; 0 on background
  real clear_x, clear_y;  // least_distance
  Noise noise;
} Receiver;

// What is known of layers behind the first before they are read.
static inline void expect_behind(Receiver* r, Frame f, scalar radius) {
  r->farthest = choose(r->point.background, (real)(0), r->depth + radius);
  const scalar x = max(fabs(f.centre_x), fabs(f.width - f.centre_x)) * f.scale_x * f.perspective;
  const scalar y = max(fabs(f.centre_y), fabs(f.height - f.centre_y)) * f.scale_y * f.perspective;
  const scalar least = (scalar)0.7 / sqrt(1 + x * x + y * y);
  r->clear_x = r->point.across_x * least;
  r->clear_y = r->point.across_y * least;
}

// No point of the ray through a pixel dx to the right and dy below is nearer to the pixel's point than this, in units of its
// depth: rays are no steeper than in the corners of the image.
static inline real least_distance(Receiver r, real dx, real dy) { return fabs(dx) * r.clear_x + fabs(dy) * r.clear_y; }

// A point that a view shows, or would show, at (x, y): column and row, not rounded. The rest of it is the caller's.
static inline Receiver receiver_of(Frame frame, scalar radius, scalar max_reach, real x, real y, real depth,
                                   real3 normal) {
  Receiver r;
  r.depth = depth;
  r.normal = normal;
  r.point = anchor_at(frame, x, y, depth);
  r.reach = reach_of(frame, r.point, radius, max_reach * (scalar)frame.width);
  expect_behind(&r, frame, radius);
  return r;
}

static inline Receiver receiver_at(Frame frame, scalar radius, scalar max_reach, PLANE depth, PLANE normal_x,
                                   PLANE normal_y, PLANE normal_z) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  mask by_both;
  Receiver r = receiver_of(frame, radius, max_reach, to_real(x), (real)(y), depth_seen(load(depth, here), &by_both),
                           load3(normal_x, normal_y, normal_z, here));
  r.x = x;
  r.y = y;
  r.here = here;
  r.noise = noise_at(x, y, frame.seed);
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

// A pixel that is left out is as open as background, and has no directions either.
static inline void leave_out(Receiver* r, mask is_wanted) { r->point.background |= !is_wanted; }

// Keeps within 0 to 1, and open on background.
static inline void store_open(real open, Receiver r, PLANE_OUT ao) {
  const real kept = smaller(larger(open, (real)(0)), (real)(1));
  store(choose(r.point.background, (real)(1), kept), ao, r.here);
}

#endif
#endif
