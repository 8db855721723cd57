// The last passes of masks of square cells: each cell is wanted if it or a cell around it is, and every pixel gets its cell's
// value. `Params` is the technique's.
//
// cells_grow    `frame`: the cells
//   in : found   1 or 0        out: grown   the largest of each cell and those around it
// cells_spread  `frame`: the image; `other`: the cells
//   in : grown                 out: result  each pixel's cell
// -D SCALE (pixels per cell)
#ifndef GLOAM_CELLS_H
#define GLOAM_CELLS_H

#include "shared/lanes/load.h"

// in : found
// out: grown
kernel void cells_grow(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const mask has_left = to_mask(FIRST_X + IOTA > 0), has_right = to_mask(FIRST_X + IOTA + 1 < frame.width);
  real most = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    if (ROW_Y + dy < 0 || ROW_Y + dy >= frame.height) continue;
    const int there = here + dy * frame.pitch;
    most = larger(load(found, there), most);
    most = larger(choose(has_left, load(found, there - 1), (real)(0)), most);
    most = larger(choose(has_right, load(found, there + 1), (real)(0)), most);
  }
  store(most, grown, here);
}

// in : grown
// out: result
kernel void cells_spread(ARGUMENTS) {
  const integer column = min(FIRST_X + IOTA, (integer)(frame.width - 1)) / SCALE;
  store(gather(grown, index_of(other, 0, ROW_Y / SCALE) + column), result, index_of(frame, FIRST_X, ROW_Y));
}

#endif
