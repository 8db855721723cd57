// How far tiles of the image are from something that moves by itself.
//
// moving_tiles     `frame`: the tiles; `other`: the image
//   in : moved     1 where something moves by itself, else 0 (reproject.cl)
//   out: moving    0 for tiles with a square of 2 x 2 such pixels, else infinity. Less is noise: what is thinner than a pixel
//                  comes and goes.
// distance_across  in : moving; out: tiles_away, in tiles along the row, to the nearest moving tile; infinity beyond REACH
// distance_down    in : moving of distance_across; out: tiles_away, in tiles along the longer of the two axes
// -D TILE (pixels), REACH (tiles)
#include "shared/lanes/load.h"

// in : moved
// out: moving
kernel void moving_tiles(ARGUMENTS) {
  const integer first = (FIRST_X + IOTA) * TILE;
  // One column and one row more, for squares across the border of two tiles.
  mask found = (mask)(0), above[TILE + 1];
  for (int dy = -1; dy < TILE; ++dy) {
    const int y = ROW_Y * TILE + dy;
    const int row = index_of(other, 0, clamp(y, 0, other.height - 1));
    const mask is_row_inside = EVERY_LANE_IF(y >= 0 && y < other.height);
    mask left = (mask)(0);
    for (int dx = -1; dx < TILE; ++dx) {
      const integer column = clamp(first + dx, (integer)(0), (integer)(other.width - 1));
      const mask here = is_row_inside & to_mask(column == first + dx) & (gather(moved, row + column) > (scalar)0.5f);
      if (dx >= 0 && dy >= 0) found |= here & left & above[dx + 1] & above[dx];
      if (dx >= 0) above[dx] = left;
      left = here;
    }
    above[TILE] = left;
  }
  store(choose(found, (real)(0), REAL_INFINITY), moving, index_of(frame, FIRST_X, ROW_Y));
}

// in : moving
// out: tiles_away
kernel void distance_across(ARGUMENTS) {
  real least = REAL_INFINITY;
  for (int dx = -REACH; dx <= REACH; ++dx) {
    const integer column = FIRST_X + dx + IOTA;
    const mask is_inside = to_mask(to_natural(column) < (natural)((uint)frame.width));
    const real there = load(moving, index_of(frame, FIRST_X + dx, ROW_Y));
    least = choose(is_inside & (there == 0), smaller(least, (real)((scalar)abs(dx))), least);
  }
  store(least, tiles_away, index_of(frame, FIRST_X, ROW_Y));
}

// in : across
// out: tiles_away
kernel void distance_down(ARGUMENTS) {
  real least = REAL_INFINITY;
  for (int dy = -REACH; dy <= REACH; ++dy) {
    if (ROW_Y + dy < 0 || ROW_Y + dy >= frame.height) continue;
    const real there = load(across, index_of(frame, FIRST_X, ROW_Y + dy));
    least = smaller(least, larger(there, (real)((scalar)abs(dy))));
  }
  store(least, tiles_away, index_of(frame, FIRST_X, ROW_Y));
}
