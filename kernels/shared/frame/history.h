// What the frame before showed of a surface, and how far its values may be used (temporal reprojection: Yang, Liu, Salvi 2020, "A
// Survey of Temporal Antialiasing Techniques", sections 3 and 4).
#ifndef GLOAM_HISTORY_H
#define GLOAM_HISTORY_H

#include "shared/sampling/sample.h"

// The four pixels of the frame before around a position. Only pixels count that show the same surface and for which something was
// kept; their weights add up to 1.
typedef struct {
  integer pixel[4];  // from the plane's start
  int is_row;        // all lanes together lie in two rows of pixels, as they do where neighbours move alike
  real weight[4];
  real frames;    // for how many frames something was kept: mean of those that count, 0 where none does
  mask is_known;  // at least one counts
} Past;

// The four pixels, and which of them lie inside the image. Their weights are those of bilinear interpolation.
typedef struct {
  Past past;
  integer column[4], row[4];
  mask is_inside[4];
} Corners;

// `x`, `y`: the position, in pixels from the centre of the first pixel.
static inline Corners corners_at(Frame frame, real x, real y) {
  Corners c;
  const real inside_x = clamp(x, (real)(-2), (real)((scalar)frame.width + 1));
  const real inside_y = clamp(y, (real)(-2), (real)((scalar)frame.height + 1));
  const real left = floor(inside_x), top = floor(inside_y), right_share = inside_x - left, lower_share = inside_y - top;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const integer column = to_integer(left) + (k & 1), row = to_integer(top) + (k >> 1);
    c.is_inside[k] = to_mask((column >= 0) & (column < frame.width) & (row >= 0) & (row < frame.height));
    c.column[k] = clamp(column, (integer)(0), (integer)(frame.width - 1));
    c.row[k] = clamp(row, (integer)(0), (integer)(frame.height - 1));
    c.past.pixel[k] = FRAME_GUARD + c.row[k] * frame.pitch + c.column[k];
    c.past.weight[k] = (k & 1 ? right_share : 1 - right_share) * (k >> 1 ? lower_share : 1 - lower_share);
    c.past.is_row = (k == 0 || c.past.is_row) && is_row_of(c.past.pixel[k]);
  }
  return c;
}

static inline real past_value(Past past, PLANE plane, int k) { return gather_row(plane, past.pixel[k], past.is_row); }

// Leaves the corners that are the same surface, and for which something was kept. `share`: their weight before it is made 1.
static inline Past past_of_same(Corners corners, PLANE history_frames, const mask* is_same, real* share) {
  Past past = corners.past;
  real sum = 0, frames = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const real kept = past_value(past, history_frames, k);
    const mask counts = is_same[k] & corners.is_inside[k] & (kept >= (scalar)0.5f);
    past.weight[k] = choose(counts, past.weight[k], (real)(0));
    sum += past.weight[k];
    frames += choose(counts, past.weight[k] * kept, (real)(0));
  }
  *share = sum;
  past.is_known = sum > (scalar)0.01f;
  const real scale = quotient((real)(1), choose(past.is_known, sum, (real)(1)));
#pragma unroll
  for (int k = 0; k < 4; ++k) past.weight[k] = choose(past.is_known, past.weight[k] * scale, (real)(0));
  past.frames = choose(past.is_known, frames * scale, (real)(0));
  return past;
}

// `depth`: the surface's, where `counts`. `same_depth`: share by which the depth may have changed.
static inline Past past_at(Frame frame, PLANE history_depth, PLANE history_frames, real x, real y, real depth,
                           scalar same_depth, mask counts) {
  const Corners corners = corners_at(frame, x, y);
  mask is_same[4];
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const real z = past_value(corners.past, history_depth, k);
    is_same[k] = counts & !is_background(z) & (fabs(z - depth) <= same_depth * depth);
  }
  real share;
  return past_of_same(corners, history_frames, is_same, &share);
}

// Weighted mean of a plane; 0 where nothing is known.
static inline real value_of(Past past, PLANE plane) {
  real value = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k)
    value += choose(past.weight[k] > 0, past.weight[k] * past_value(past, plane, k), (real)(0));
  return value;
}

// Neighbours of a row of pixels that show a surface at about the same depth: every second pixel of 5 x 5, since filtered neighbours
// that touch are alike.
typedef struct {
  mask counts[9];
  real share;  // weight of each in their mean
} Alike;

static inline int around_column(int i) { return 2 * (i % 3) - 2; }
static inline int around_row(Frame frame, int i) { return clamp(ROW_Y + 2 * (i / 3) - 2, 0, frame.height - 1); }

static inline Alike alike_around(Frame frame, PLANE depth, real own, scalar same_depth) {
  Alike alike;
  real count = 0;
  for (int i = 0; i < 9; ++i) {
    const integer column = FIRST_X + around_column(i) + IOTA;
    const real z = load(depth, index_of(frame, FIRST_X + around_column(i), around_row(frame, i)));
    alike.counts[i] =
        to_mask((column >= 0) & (column < frame.width)) & !is_background(z) & (fabs(z - own) <= same_depth * own);
    count += choose(alike.counts[i], (real)(1), (real)(0));
  }
  alike.share = quotient((real)(1), larger(count, (real)(1)));
  return alike;
}

// Mean of the neighbours, and their mean absolute deviation from it: not squared, as radiance may be large.
typedef struct {
  real mean, deviation;
} Around;

static inline Around around_of(Frame frame, Alike alike, PLANE plane) {
  real value[9];
  Around a;
  a.mean = a.deviation = 0;
  for (int i = 0; i < 9; ++i) {
    const int there = index_of(frame, FIRST_X + around_column(i), around_row(frame, i));
    value[i] = choose(alike.counts[i], load(plane, there), (real)(0));
    a.mean += value[i];
  }
  a.mean *= alike.share;
  for (int i = 0; i < 9; ++i) a.deviation += choose(alike.counts[i], fabs(value[i] - a.mean), (real)(0));
  a.deviation *= alike.share;
  return a;
}

// A value clamped to `within` deviations around the neighbours' mean.
static inline real kept_near(Around a, real value, scalar within) {
  const real reach = within * a.deviation;
  return clamp(value, a.mean - reach, a.mean + reach);
}

#endif
