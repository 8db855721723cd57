// A stochastic depth map from all surfaces under a pixel (Vermeer, Scandolo, Eisemann 2021, section 3.1): every surface is
// offered to some of the samples, and each sample keeps the nearest that it was offered. HIDDEN: surfaces behind the nearest
// alone are offered. JITTER 0: the samples hold the surfaces that are offered, the nearest in the first. RELEVANT: of the hidden
// surfaces only those are offered that may be within the radius of something visible. Depth is divided into slices of one radius;
// each tile of pixels knows (shared/both/relevant.h) in which slices a tile within reach shows something, and the slices beside these.
//
// in : depth       view-space z of the nearest surface, scene units, +inf = background
//      peel        stack of all surfaces under the pixel centre, the nearest among them
// out: stochastic  stack of SAMPLES depths; +inf where a sample was offered nothing
// slices_of_tiles, slices_across, slices_down: `frame` is the tiles; of slices_of_tiles and the map `other` is the other resolution
//      slices      whole number with a bit for each slice; every RELEVANT_SLICES-th slice has the same one
//      reach       how far something in the tile looks for occluders, in tiles
// -D SAMPLES, HIDDEN, HASHED, JITTER, RELEVANT, PEEL_LAYERS
#include "shared/lanes/load.h"
#include "shared/lanes/math.h"
#include "shared/both/relevant.h"
#include "shared/both/stochastic.h"

#if RELEVANT
// Where lanes do not count, no slice.
static inline natural slice_where(mask counts, real depth, scalar radius) {
  const natural bit = slice_of(choose(counts, depth, (real)(0)), radius);
  return to_natural(choose(counts, to_real(bit), (real)(0)));
}

// in : depth
// out: slices, reach
kernel void slices_of_tiles(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const integer first = (FIRST_X + IOTA) * RELEVANT_TILE;
  natural shown = (natural)(0u);
  real nearest = REAL_INFINITY;
  for (int dy = 0; dy < RELEVANT_TILE; ++dy) {
    const int row = index_of(other, 0, min(ROW_Y * RELEVANT_TILE + dy, other.height - 1));
    for (int dx = 0; dx < RELEVANT_TILE; ++dx) {
      const real seen = gather(depth + row, min(first + dx, (integer)(other.width - 1)));
      shown |= slice_where(seen < REAL_INFINITY, seen, params.radius);
      nearest = smaller(nearest, seen);
    }
  }
  const real x = to_real(first) + RELEVANT_TILE / 2 - other.centre_x,
             y = (real)(ROW_Y * RELEVANT_TILE + RELEVANT_TILE / 2) - other.centre_y;
  const mask shows = (nearest < REAL_INFINITY) & (mask)(EVERY_LANE_IF(params.radius > 0));
  const real far = reach_in_tiles(other, x, y, choose(shows, nearest, (real)(1)), params.radius,
                                  params.max_reach * other.width);
  store(choose(shows, to_real(with_slices_beside(shown)), (real)(0)), slices, here);
  store(choose(shows, far, (real)(0)), reach, here);
}

// The slices of all tiles of a row that reach this one; `further`: how far up and down these still reach.
// in : slices, reach
// out: row_slices, further
kernel void slices_across(ARGUMENTS) {
  const int row = index_of(frame, 0, ROW_Y), here = index_of(frame, FIRST_X, ROW_Y);
  natural found = (natural)(0u);
  real most = 0;
  for (int column = 0; column < frame.width; ++column) {
    const real far = (real)(reach[row + column]), gap = gap_between(to_real(FIRST_X + IOTA - column));
    const mask reaches = gap <= far;
    found |= to_natural(choose(reaches, (real)(slices[row + column]), (real)(0)));
    most = larger(most, choose(reaches, far * far - gap * gap, (real)(0)));
  }
  store(to_real(found), row_slices, here);
  store(sqrt(most), further, here);
}

// in : row_slices, further
// out: slices
kernel void slices_down(ARGUMENTS) {
  natural found = (natural)(0u);
  for (int row = 0; row < frame.height; ++row) {
    const int there = index_of(frame, FIRST_X, row);
    const mask reaches = gap_between((real)(row - ROW_Y)) <= load(further, there);
    found |= to_natural(choose(reaches, load(row_slices, there), (real)(0)));
  }
  store(to_real(found), slices, index_of(frame, FIRST_X, ROW_Y));
}
#endif

static inline natural subset_of(natural hash, uint alpha) {
#if HASHED
  natural subset = (natural)(0u);
  for (int j = 0; j < SAMPLES; ++j) subset |= hashed_bit(hash, (natural)((uint)j), (natural)(alpha)) << j;
  return subset;
#else
  return stratified_subset(hash, (natural)(alpha), SAMPLES);
#endif
}

// Each of the samples that `subset` names keeps the nearer of what it holds and the surface.
static inline void offer(real surface, natural subset, real* samples) {
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) {
    const mask is_offered = to_mask((subset & (1u << j)) != 0u);
    samples[j] = smaller(choose(is_offered, surface, REAL_INFINITY), samples[j]);
  }
}

// The samples stay in order, and the farthest of them and the surface is dropped.
static inline void insert(real surface, real* samples) {
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) {
    const real further = larger(surface, samples[j]);
    samples[j] = smaller(surface, samples[j]);
    surface = further;
  }
}

// in : depth, peel; slices
// out: stochastic
kernel void stochastic_depth_map(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const natural x = to_natural(FIRST_X + IOTA), y = (natural)((uint)ROW_Y), seed = (natural)((uint)frame.seed);
  const real seen = load(depth, here);
  const natural first = as_natural(to_stored(seen));
  const uint alpha = (uint)(params.alpha * STOCHASTIC_ONE);
#if RELEVANT
  const integer tile = min(FIRST_X + IOTA, (integer)(frame.width - 1)) / RELEVANT_TILE;
  const natural relevant = to_natural(gather(slices + index_of(other, 0, ROW_Y / RELEVANT_TILE), tile));
#endif
  real samples[SAMPLES];
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) samples[j] = REAL_INFINITY;
  for (int k = 0; k < PEEL_LAYERS; ++k) {
    real surface = load(layer_of(peel, frame, k), here);
#if HIDDEN
    surface = choose(surface > seen, surface, REAL_INFINITY);
#endif
    if (!ANY(surface < REAL_INFINITY)) continue;
#if RELEVANT
    const natural slice = slice_where(surface < REAL_INFINITY, surface, params.radius);
    surface = choose(to_mask((relevant & slice) != 0u), surface, REAL_INFINITY);
#endif
#if !JITTER
    insert(surface, samples);
#else
    offer(surface, subset_of(surface_hash(x, y, seed, as_natural(to_stored(surface)), first), alpha), samples);
#endif
  }
#pragma unroll
  for (int j = 0; j < SAMPLES; ++j) store(samples[j], layer_of_out(stochastic, frame, j), here);
}
