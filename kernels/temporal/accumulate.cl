// Raw ambient occlusion, or indirect light, as the mean over the frames of a sequence that showed each surface (Yang, Liu, Salvi 2020, sections 3 and 4).
// What follows filters the mean. The history counts for as many frames as reproject.cl says. Where these are more than a few, near something
// that moves, it is compared with this frame: where their means over neighbours differ by more than the noise of these means, the history
// counts for as many frames as have that error.
//
// in : now            raw AO of this frame, 1 = open .. 0 = closed; or its raw light
//      depth          view-space z, scene units, +inf = background
//      before, before_frames, before_count  of reproject.cl
//      tiles_away     of moving.cl, in tiles
// out: result         mean over the frames; AO of 1 and light of 0 on background
//      frames         how many frames have shown the surface since it came into view or changed; 0 on background
// -D TILE (pixels), REACH (tiles), COMPONENTS
#include "shared/frame/camera.h"
#include "shared/lanes/components.h"
#include "shared/lanes/load.h"
#include "shared/sampling/sample.h"

// A history that counts for so few frames passes by itself, before a comparison of noise with noise could tell.
#define LEAST_TESTED ((scalar)3)

// Of a value over neighbours: the squared difference of this frame's mean from that of the frame before, and the variance in this
// frame.
typedef struct {
  real difference, variance;
} Change;

// As far as squares can hold.
static inline real compared(Sources sources, int component, int there) {
  const real value = load(sources.planes[component], there);
#if COMPONENTS == 1
  return value;
#else
  return smaller(value, (real)(1e17f));
#endif
}

static inline Change change_of(real sum, real squares, real sum_before, real share) {
  const real mean = sum * share, difference = mean - sum_before * share;
  Change change;
  change.difference = difference * difference;
  // Never 0, so that equal pixels divide too: a step of 8 bits is no change. Light has no scale but its own.
#if COMPONENTS == 1
  const real least = (scalar)1e-4f;
#else
  const real least = (scalar)1e-4f * mean * mean + (scalar)1e-30f;
#endif
  change.variance = larger(squares * share - mean * mean, (real)(0)) + least;
  return change;
}

// The frames that the history counts for, 1 / (1 / count + excess): the excess of the squared difference of two means over what noise
// explains, in variances of a single frame. Neighbours: every second pixel of 5 x 5, since samples of neighbours that touch differ most.
static inline real frames_alike(Frame frame, Params params, real z, real count, real tolerance, Sources now,
                                PLANE depth, Sources before, PLANE before_frames) {
  real pixels = 0, sum[COMPONENTS], squares[COMPONENTS], sum_before[COMPONENTS];
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) sum[c] = squares[c] = sum_before[c] = (real)(0);
  for (int k = 0; k < 9; ++k) {
    const int dx = 2 * (k % 3) - 2, dy = 2 * (k / 3) - 2;
    if (ROW_Y + dy < 0 || ROW_Y + dy >= frame.height) continue;
    const int there = index_of(frame, FIRST_X + dx, ROW_Y + dy);
    const real depth_there = load(depth, there);
    const mask counts = to_mask(to_natural(FIRST_X + dx + IOTA) < (natural)((uint)frame.width)) &
                        (load(before_frames, there) > 0) & !is_background(depth_there) &
                        (fabs(depth_there - z) <= params.depth_change * z);
    pixels += choose(counts, (real)(1), (real)(0));
#pragma unroll
    for (int c = 0; c < COMPONENTS; ++c) {
      const real value = compared(now, c, there), value_before = compared(before, c, there);
      sum[c] += choose(counts, value, (real)(0));
      squares[c] += choose(counts, value * value, (real)(0));
      sum_before[c] += choose(counts, value_before, (real)(0));
    }
  }
  const real share = quotient((real)(1), larger(pixels, (real)(1)));
  real difference = 0, variance = 0;
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) {
    const Change change = change_of(sum[c], squares[c], sum_before[c], share);
    difference += change.difference;
    variance += change.variance;
  }
  const real excess = quotient(difference, variance) - tolerance * share;
  return quotient((real)(1), quotient((real)(1), count) + larger(excess, (real)(0)));
}

// in : now, depth, before, before_frames, before_count, tiles_away
// out: result, frames
kernel void temporal_accumulate(ARGUMENTS) {
  const Sources nows = SOURCE_PLANES(now), befores = SOURCE_PLANES(before);
  const Results results = RESULT_PLANES(result);
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here);
  const mask is_surface = !is_background(z);
  real seen = load(before_frames, here), count = load(before_count, here);
  const scalar tiles = tiles_away[index_of(other, FIRST_X / TILE, ROW_Y / TILE)];
  // From pixel to pixel at least; a tile beside that of the pixel may begin at the next pixel.
  const scalar pixels = (tiles - 1) * TILE;
  const real reach = (scalar)params.radius / ((scalar)frame.scale_x * (frame.perspective * z + frame.parallel));
  // Nothing within REACH tiles: the radius may be infinite too.
  mask may_change = tiles <= REACH ? is_surface & (count > LEAST_TESTED) & (reach >= pixels) : (mask)(0);
  real tolerance = (real)(params.change_tolerance);
#if COMPONENTS > 1
  // Light also changes where nothing moves, as a lamp goes out.
  tolerance = choose(may_change, tolerance, (real)(params.light_tolerance));
  may_change = is_surface & (count > LEAST_TESTED);
#endif
  if (ANY(may_change)) {
    const real alike = frames_alike(frame, params, z, choose(may_change, count, (real)(1)), tolerance, nows, depth,
                                    befores, before_frames);
    seen = choose(may_change & (alike < count), alike, seen);
    count = choose(may_change, alike, count);
  }
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c) {
    const real mean = mean_of(load(befores.planes[c], here) * count + load(nows.planes[c], here), count + 1);
    store(choose(is_surface, mean, NO_RESULT), results.planes[c], here);
  }
  store(choose(is_surface, seen + 1, (real)(0)), frames, here);
}
