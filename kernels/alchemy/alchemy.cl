// Alchemy ambient obscurance (McGuire, Osman, Bukowski, Hennessy 2011) and with SCALABLE Scalable Ambient Obscurance
// (McGuire, Mara, Luebke 2012): mean obscurance over samples on a spiral on the screen.
//   AO = max(0, 1 - 2 strength / n * sum max(0, v.n - bias) / (v.v + epsilon))^power
//   AO = max(0, 1 - 5 strength / n * sum (1 - v.v)^3 max(0, v.n - bias) / (v.v + epsilon))^power   with SCALABLE
// v: from the pixel's point to an occluder, in radii. Of the layers at a sample, the one that contributes most counts.
//
// in : depth         view-space z, scene units, +inf = background
//      normal        unit, view space
//      occluders     further depth layers (layers.h); without them, depth is the only layer
//      depth_levels  levels 1 to LEVELS, made by sao_level (LEVELS > 0, without occluders)
// out: ao_raw        1 = open .. 0 = closed, unfiltered; 1 on background
// -D SAMPLES, TURNS, SCALABLE, LEVELS, POWER, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT, COMPENSATED;
//    LEVEL (sao_level)
#include "shared/sampling/ambient_occlusion.h"
#include "estimators/alchemy.h"
#ifndef LEVEL
#include "shared/sampling/spiral.h"
#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif
#endif

#if SCALABLE
#define FACTOR 5
#else
#define FACTOR 2
#endif

#if LEVELS && !defined(OCCLUDERS_LAYERS)
#define READS_LEVELS
#define DEPTH_LEVELS_FROM(depth)
#else
#define DEPTH_LEVELS_FROM(depth) PLANE depth_levels = depth;
#endif

static inline real obscurance(real3 v, real3 n, Params params, Falloff falloff) {
#if SCALABLE
  return obscurance_scalable(v, n, params.bias, falloff);
#else
  return obscurance_alchemy(v, n, params.bias, falloff);
#endif
}

// --- Levels of the depth, after the second paper. Level 0 is the depth itself. Level k has one pixel for 2^k x 2^k pixels
// of the image. A level picks one of each 2 x 2 pixels of the level below: (2x + (y & 1), 2y + (x & 1)), a rotated grid.
// Each step down exchanges the lowest bits of x and y, so that the bits of both alternate: the picked pixel of the image
// follows from (x, y) alone, and its position is exact.
#if LEVELS

// Every second bit from bit 29 down.
#define ALTERNATING ((integer)(0x2AAAAAAA))

// The pixel of the image that pixel (x, y) of a level was picked from; for a block that crosses the border, the border's.
static inline void picked_pixel(Frame image, integer level, integer x, integer y, integer* column, integer* row) {
  const integer first = ALTERNATING >> (30 - level), second = ALTERNATING >> (31 - level);
  const integer odd_x = -(x & 1), odd_y = -(y & 1);
  *column = min((x << level) | (odd_y & first) | (odd_x & second), image.width - 1);
  *row = min((y << level) | (odd_x & first) | (odd_y & second), image.height - 1);
}

// The level for a sample `distance` pixels away: floor(log2(distance)) - level_offset. In a frame of more than 2^31 / LEVELS
// pixels it is capped at the levels that an int can index.
static inline integer level_of(Frame frame, Params params, real distance) {
  const integer exponent = (as_integer(to_stored(distance)) >> 23) - 127;
  const int highest = min(LEVELS, 0x7fffffff / (2 * FRAME_GUARD + frame.pitch * frame.height));
  return clamp(exponent - params.level_offset, (integer)(0), (integer)(highest));
}

#ifdef LEVEL
// `frame`: the level; `other`: the image. Writes layer LEVEL - 1, laid out like the image, in its left top part.
// in : depth
// out: depth_levels
kernel void sao_level(ARGUMENTS) {
  integer column, row;
  picked_pixel(other, (integer)(LEVEL), FIRST_X + IOTA, (integer)(ROW_Y), &column, &row);
  const real picked = gather(depth, FRAME_GUARD + row * other.pitch + column);
  store(picked, layer_of_out(depth_levels, other, LEVEL - 1), index_of(other, FIRST_X, ROW_Y));
}
#endif
#endif

#ifndef LEVEL
// Where a sample is read.
typedef struct {
  integer dx, dy;  // offset in pixels
  mask coarse;     // from a level above 0
  integer index;   // in depth_levels
} Place;

static inline Place place_at(Frame frame, Params params, Receiver r, integer dx, integer dy, real distance) {
  Place p;
#if LEVELS
  const integer level = level_of(frame, params, distance);
  const integer x = (r.x + dx) >> level, y = (r.y + dy) >> level, layer = max(level - 1, 0);
  integer column, row;
  picked_pixel(frame, level, x, y, &column, &row);
  p.dx = column - r.x;
  p.dy = row - r.y;
  p.coarse = to_mask(level > 0);
  p.index = layer * (2 * FRAME_GUARD + frame.pitch * frame.height) + FRAME_GUARD + y * frame.pitch + x;
#else
  p.dx = dx;
  p.dy = dy;
#endif
  return p;
}

// Depth of the first layer at a place. Further layers are read at full resolution: they have no levels.
static inline real depth_at(Frame frame, DepthLayers layers, global const float* depth_levels, Receiver r, Place p,
                            int within) {
#ifdef READS_LEVELS
  if (ANY(p.coarse)) {
    const real coarse = gather(depth_levels, p.index);
    if (!ANY(!p.coarse)) return coarse;
    return choose(p.coarse, coarse, sample_near(layers.first, frame, r.here, within, p.dx, p.dy));
  }
#endif
  return sample_near(layers.first, frame, r.here, within, p.dx, p.dy);
}

// The contribution of the layer that contributes most.
static inline real obscurance_near(Frame frame, Params params, DepthLayers layers, global const float* depth_levels,
                                   Receiver r, Falloff falloff, Place p, int within) {
  const real depth = depth_at(frame, layers, depth_levels, r, p, within), x = to_real(p.dx), y = to_real(p.dy);
  const integer index = index_within(frame, within, p.dx, p.dy);
#if GATHERS_ONLY
  real sum = depth;
  FOR_DEPTHS_BEHIND(behind, layers, frame, r.here, index, EVERY_LANE, r.farthest) sum += behind.next;
  return sum;
#else
  const real3 v = towards_depth(frame, r, x, y, depth);
  const real by_first = obscurance(v, r.normal, params, falloff);
  const mask rises = fused_dot3(r.normal, v) > params.bias;
  const mask asked = asks_behind(r, rises, v.z > 0, square_of(v) * r.reach.inverse_square >= 1);
  real largest = by_first;
  FOR_DEPTHS_BEHIND(behind, layers, frame, r.here, index, asked, r.farthest) {
    const real found = obscurance(towards_depth(frame, r, x, y, behind.next), r.normal, params, falloff);
    largest = choose(behind.counts, larger(found, largest), largest);
  }
  return COMPENSATE(params, largest, by_first);
#endif
}

static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, Params params, DepthLayers layers,
                                                                    global const float* depth_levels, Receiver r,
                                                                    Falloff falloff, Spiral spiral, int within) {
  real sum = 0;
#pragma unroll 4
  for (int k = 0; k < SAMPLES; ++k) {
    integer dx, dy;
    sample_at(spiral, &dx, &dy);
    const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
    const Place p = place_at(frame, params, r, dx, dy, larger(spiral.distance_x, spiral.distance_y));
    const real found = obscurance_near(frame, params, layers, depth_levels, r, falloff, p, within);
    sum += counted(counts, found);
    next_sample(&spiral);
  }
  return sum;
}

// in : depth, normal; wanted, occluders, depth_levels
// out: ao_raw
kernel void alchemy_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  DEPTH_LEVELS_FROM(depth)
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  if (!ANY(!r.point.background)) {
    store((real)(1), ao_raw, r.here);
    return;
  }
  const Falloff falloff = falloff_of(r.reach, params.epsilon);
  const Spiral spiral = spiral_of(r.reach, r.noise);
  real sum;
  LOOK_AROUND(sum, frame, r, r.reach,
              sum_of_obscurance(frame, params, layers, depth_levels, r, falloff, spiral, within))
  const real mean = sum * falloff.radius * (params.strength * FACTOR / SAMPLES);
  const real open = smaller(larger(1 - mean, (real)(0)), (real)(1));
  real ao = open;
  for (int k = 1; k < POWER; ++k) ao *= open;
  store_open(ao, r, ao_raw);
}
#endif
