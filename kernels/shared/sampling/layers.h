// The depths that an estimate reads at a sample: one layer, every layer of a stack, or the depth and the hidden depths behind it.
#ifndef GLOAM_LAYERS_H
#define GLOAM_LAYERS_H

#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

// Where occluders are looked for: in the depth alone, in every layer of a stack whose first is the depth, or with STOCHASTIC in
// the depth and then in every layer of a stack. A kernel's first lines:
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
#define LAYERS_FROM(frame, depth) depth_layers(depth, depth)
#endif

// As LAYERS_FROM, for the other of two views.
#if OCCLUDERS_LAYERS
#define OTHER_LAYERS_FROM(frame, depth) depth_layers(depth, other_occluders)
#else
#define OTHER_LAYERS_FROM(frame, depth) depth_layers(depth, depth)
#endif

// A depth of the first layer. `by_both`: whether both eyes see it, which the sign of the stored depth tells (visibility.h).
static inline real depth_seen(real stored_depth, mask* by_both) {
#if STEREO
  *by_both = stored_depth < 0;
  return fabs(stored_depth);
#else
  *by_both = (mask)(0);
  return stored_depth;
#endif
}

// Where layers behind the first are read (section 3.3). EARLY_OUT 0: everywhere. 1: where the first `rises` over the tangent
// plane so far that a depth behind it may still count; where the ray through its pixel does not climb away from that plane, depths
// behind it lie lower, so the result stays the same (asks_behind, ambient_occlusion.h, sees to the others). 2: where moreover the
// first is nearer to the eye than the pixel's point, and out of reach.
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

// Layers behind the first are read in groups: stacks that a technique has sorted hold GROUP depths side by side, pixel by pixel,
// front to back. The layers of a frame come in any order.
#if STOCHASTIC && OCCLUDERS_LAYERS % 4 == 0
#define GROUP 4
#elif STOCHASTIC && OCCLUDERS_LAYERS % 2 == 0
#define GROUP 2
#else
#define GROUP 1
#endif

// Two depths behind the first that are read at once.
typedef struct {
  real next, later;
  mask counts;  // lanes for which `next` counts
} Behind;

// Reads depth `k` behind the first, at an index from `here`, into `behind->next`. Returns 0 if no lane that asks can find a depth
// before `farthest` from there on in a sorted stack. Call with k = 0, 1, ... in order.
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
  // Per lane, so that no lane depends on another.
  behind->counts = asked & (behind->next < farthest);
  return ANY(behind->counts);
#else
  behind->counts = asked;
  return 1;
#endif
}

// Loops over the depths of a sample behind the first. The estimator takes the first depth itself, which decides which lanes are
// `asked`; the statement or block that follows takes the others, as `behind.next` where `behind.counts`.
//   FOR_DEPTHS_BEHIND(behind, layers, frame, here, index, asked, farthest) { ... }
#define FOR_DEPTHS_BEHIND(behind, layers, f, here, index, asked, farthest)                                             \
  Behind behind;                                                                                                       \
  _Pragma("unroll 4") for (int layer = 0;                                                                              \
                           layer < LAYERS - 1 && look_behind(layers, f, layer, here, index, asked, farthest, &behind); \
                           ++layer)

// The reads of an estimate without its computation (GATHERS_ONLY).
static inline __attribute__((always_inline)) real sum_of_depths(DepthLayers layers, Frame f, int here, integer index,
                                                                real farthest) {
  real sum = gather(layers.first + here, index);
  FOR_DEPTHS_BEHIND(behind, layers, f, here, index, EVERY_LANE, farthest) sum += smaller(behind.next, farthest);
  return sum;
}

// Writes a group of depths.
static inline void store_group(const real* depths, global float* layers, int here) {
#if GROUP == 1
  store(depths[0], layers, here);
#elif GROUP == 2
  store_pair(depths[0], depths[1], layers, here);
#else
  store_four(depths[0], depths[1], depths[2], depths[3], layers, here);
#endif
}

// Occlusion by all layers, where the part that hidden layers add to the first is multiplied by a factor, as they miss some
// surfaces (section 4).
#if COMPENSATED
#define COMPENSATE(params, all, by_first) ((by_first) + (params).compensation * ((all) - (by_first)))
#else
#define COMPENSATE(params, all, by_first) (all)
#endif

#endif
