// The hierarchy of depths through which rays are followed (Stachowiak and Uludag 2015; screen_ray.h): the nearest and the farthest
// surface of each cell.
//
// in : depth       view-space z, scene units, +inf = background
//      back_depth  of the back of what is seen (TRAVERSAL)
// out: nearness, farness  LEVELS levels, one after another, in tiles: 1 / depth, orthographic -depth
//      list, others       lists of rays, emptied
// -D TRAVERSAL, LEVELS; LEVEL (ssr_level)
#include "shared/lanes/pixel_list.h"
#include "shared/rays/screen_ray.h"

// in : depth; back_depth
// out: nearness, list; farness, others
kernel void ssr_nearness(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y), cell = index_of_tile_row(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here), least = (real)(nearness_of_background(frame));
  const mask is_inside = to_mask(FIRST_X + IOTA < frame.width) & !is_background(z);
  const real nearest = choose(is_inside, nearness_of(frame, choose(is_inside, z, (real)(1))), least);
  store(nearest, nearness, cell);
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(list);
#if TRAVERSAL
  // A surface extends to its back, where that is known.
  const real back = load(back_depth, here);
  const mask has_back = is_inside & !is_background(back);
  store(choose(has_back, smaller(nearness_of(frame, choose(has_back, back, (real)(1))), nearest), nearest), farness,
        cell);
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(others);
#endif
}

#ifdef LEVEL
// Row y of a level, for the row of cells above it: the first and the second of each two neighbouring cells.
static inline void load_pairs(PLANE level, Frame image, int y, real* first, real* second) {
#if LANES == 1
  *first = load(level, index_of_tile_row(image, 2 * FIRST_X, y));
  *second = load(level, index_of_tile_row(image, 2 * FIRST_X + 1, y));
#else
  const stored a = JOIN(vload, LANES)(0, level + index_of_tile_row(image, 2 * FIRST_X, y));
  // Beyond the last tile there is nothing, and nothing there is used.
  const int next = min(2 * FIRST_X + LANES, image.pitch - LANES);
  const stored b = JOIN(vload, LANES)(0, level + index_of_tile_row(image, next, y));
  stored even, odd;
  even.lo = a.even;
  even.hi = b.even;
  odd.lo = a.odd;
  odd.hi = b.odd;
  *first = to_real(even);
  *second = to_real(odd);
#endif
}

// The largest of each four cells in the rows `y` and `next` of the level below.
static inline real larger_of_four(PLANE level, Frame image, int y, int next) {
  real a, b, c, d;
  load_pairs(level, image, y, &a, &b);
  load_pairs(level, image, next, &c, &d);
  return larger(larger(a, b), larger(c, d));
}

// The smallest of each four cells. Columns beyond `columns` do not count.
static inline real smaller_of_four(PLANE level, Frame image, int y, int next, int columns) {
  real a, b, c, d;
  load_pairs(level, image, y, &a, &b);
  load_pairs(level, image, next, &c, &d);
  const mask has_second = to_mask(2 * (FIRST_X + IOTA) + 1 < columns);
  return choose(has_second, smaller(smaller(a, b), smaller(c, d)), smaller(a, c));
}

// `frame`: the level; `other`: the image.
// out: nearness, farness
kernel void ssr_level(ARGUMENTS) {
  const int below = LEVEL - 1, columns = (other.width + (1 << below) - 1) >> below;
  const int rows = (other.height + (1 << below) - 1) >> below, y = 2 * ROW_Y, next = min(y + 1, rows - 1);
  const int here = index_of_tile_row(other, FIRST_X, ROW_Y);
  const int start = START_OF_LEVEL(other, int, LEVEL), start_below = START_OF_LEVEL(other, int, below);
  global const float* near_below = nearness + start_below;
  const mask is_inside = to_mask(FIRST_X + IOTA < frame.width);
  const real nearest = larger_of_four(near_below, other, y, next);
  store(choose(is_inside, nearest, (real)(nearness_of_background(other))), nearness + start, here);
#if LEVEL == 1 && !TRAVERSAL
  // In a single pixel the nearest surface is the farthest too.
  global const float* far_below = near_below;
#else
  global const float* far_below = farness + start_below;
#endif
  store(smaller_of_four(far_below, other, y, next, columns), farness + start, here);
}
#endif
