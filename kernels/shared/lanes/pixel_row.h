// Reading the other of two views at a pixel per lane. Along most surfaces these pixels follow one another, but for a step of one
// pixel now and then: two loads are quicker than a gather. In a reduced view (upsample.h) several lanes share a pixel, and one
// load holds those of all lanes.
#ifndef GLOAM_PIXEL_ROW_H
#define GLOAM_PIXEL_ROW_H

#include "shared/lanes/load.h"

typedef struct {
  integer column, row;  // of each lane
  int first_column, y;  // column of the first lane before the step; row of all lanes
  mask is_further;      // lanes behind the step
  integer lane;         // lane of a load from the first column on that holds each lane's pixel
} PixelRow;

// How the lanes' pixels are arranged.
#define ANYWHERE 0
#define IN_A_ROW 1       // one after another
#define WITHIN_A_LOAD 2  // in a row, and in no more columns than there are lanes

static inline int lowest_lane(integer v) {
#if LANES == 1
  return v;
#else
#if LANES == 16
  const int8 half_of = min(v.lo, v.hi);
  const int4 quarter = min(half_of.lo, half_of.hi);
#elif LANES == 8
  const int4 quarter = min(v.lo, v.hi);
#else
  const int4 quarter = v;
#endif
  const int2 last = min(quarter.lo, quarter.hi);
  return min(last.x, last.y);
#endif
}

// IN_A_ROW where the pixels of the lanes that count follow one another, else ANYWHERE. Call it only if at least one lane counts.
static inline int follow_in_a_row(integer column, integer row, mask counts, PixelRow* p) {
  const integer offset = column - (FIRST_X + IOTA), which = integer_of(counts);
  const int lowest = lowest_lane(which ? offset : (integer)(INT_MAX));
  p->column = column;
  p->row = row;
  p->first_column = FIRST_X + lowest;
  p->y = lowest_lane(which ? row : (integer)(INT_MAX));
  p->is_further = to_mask(offset > lowest);
  return ANY(counts & to_mask((offset > lowest + 1) | (row != p->y))) ? ANYWHERE : IN_A_ROW;
}

// As follow_in_a_row, for WITHIN_A_LOAD or ANYWHERE.
static inline int lie_within_a_load(integer column, integer row, mask counts, PixelRow* p) {
  const integer which = integer_of(counts);
  p->column = column;
  p->row = row;
  p->first_column = lowest_lane(which ? column : (integer)(INT_MAX));
  p->y = lowest_lane(which ? row : (integer)(INT_MAX));
  const integer lane = column - p->first_column;
  p->lane = which ? lane & (LANES - 1) : (integer)(0);
  return ANY(counts & to_mask((lane != p->lane) | (row != p->y))) ? ANYWHERE : WITHIN_A_LOAD;
}

// Values at the pixels `dx` to the right of and `dy` below each lane's, clamped to the image. `how`: their arrangement, a
// constant. Unless it is ANYWHERE, lanes that do not count get any value.
static inline __attribute__((always_inline)) real value_at(Frame f, global const float* plane, const PixelRow* p,
                                                           int dx, int dy, int how) {
  if (how != ANYWHERE) {
    const int first = index_of(f, p->first_column + dx, clamp(p->y + dy, 0, f.height - 1));
    if (how == WITHIN_A_LOAD) return lane_of(load(plane, first), p->lane);
    return choose(p->is_further, load(plane, first + 1), load(plane, first));
  }
  const integer x = clamp(p->column + dx, (integer)(0), (integer)(f.width - 1));
  const integer y = clamp(p->row + dy, (integer)(0), (integer)(f.height - 1));
  return gather(plane, FRAME_GUARD + y * f.pitch + x);
}

#endif
