// Where one eye shows what the other does not: half-occlusion. What the other eye alone sees can change what is found for a
// point only within the radius of it; elsewhere the second look is spared (Shi, Billeter, Eisemann 2022, section 5).
//
// Space is cut into cells as wide as the radius, and every cell that lies within it of something half-occluded is marked
// in a table of floats, found by a hash: 1 where marked. Cells of one slot in the table are marked together, which costs a
// look too many and misses none. The table lies in a plane's memory, and is of the eye that sees what is half-occluded.
#ifndef GLOAM_HALF_OCCLUSION_H
#define GLOAM_HALF_OCCLUSION_H

#include "shared/frame/neighbour.h"

// Slots in the table: a power of two that fits a plane.
#define MOST_CELLS (1 << 17)
static inline int bits_of_cells(Frame f) {
  return 31 - (int)clz(min((uint)MOST_CELLS, (uint)f.pitch * (uint)f.height));
}

// The whole table is emptied by work-items for all pixels of the image.
static inline void empty_cells(PLANE_OUT cells, Frame f, int here) {
  if (here < FRAME_GUARD + (1 << bits_of_cells(f))) store((real)(0), cells, here);
}

typedef struct {
  integer x, y, z;
} GridCell;

// Along one axis. A radius of 0 or of no end puts everything into few cells: all of it is looked at.
static inline integer cell_along(real coordinate, scalar radius) {
  const real most = (real)(0x1p20f), cell = floor(coordinate / radius);
  return to_integer(smaller(larger(cell, -most), most));
}

static inline GridCell grid_cell_of(real3 p, scalar radius) {
  GridCell c;
  c.x = cell_along(p.x, radius);
  c.y = cell_along(p.y, radius);
  c.z = cell_along(p.z, radius);
  return c;
}

// Slot in the table.
static inline integer slot_of(Frame f, GridCell c) {
  const natural h = to_natural(c.x) * 0x8da6b343u + to_natural(c.y) * 0xd8163841u + to_natural(c.z) * 0xcb1ab31fu;
  return to_integer(h >> (uint)(32 - bits_of_cells(f))) + FRAME_GUARD;
}

// Marks a cell and all that lie within the radius of it. Each lane takes some of these; the last comes out more than once.
static inline void mark_around(PLANE_OUT cells, Frame f, int x, int y, int z) {
  for (int first = 0; first < 27; first += LANES) {
    const integer k = min((integer)(first) + IOTA, (integer)(26));
    GridCell c;
    c.x = x + k % 3 - 1;
    c.y = y + k / 3 % 3 - 1;
    c.z = z + k / 9 - 1;
    scatter((real)(1), cells, slot_of(f, c));
  }
}

// The same around the points of a mask, once for each cell that they lie in.
static inline void mark_around_all(PLANE_OUT cells, Frame f, real3 p, scalar radius, mask which) {
  if (!ANY(which)) return;
  const GridCell c = grid_cell_of(p, radius);
  const int *x = (const int*)&c.x, *y = (const int*)&c.y, *z = (const int*)&c.z;
  integer is_left = integer_of(which);
  const int* left = (const int*)&is_left;
  for (int i = 0; i < LANES; ++i) {
    if (!left[i]) continue;
    mark_around(cells, f, x[i], y[i], z[i]);
    is_left &= (c.x != x[i]) | (c.y != y[i]) | (c.z != z[i]);
  }
}

// Whether a point lies in a cell that is marked; `p`: in the space of the eye whose table it is.
static inline mask is_near_marked(PLANE cells, Frame f, real3 p, scalar radius) {
  return gather(cells, slot_of(f, grid_cell_of(p, radius))) > 0;
}

// Fewer pixels of a row than this that one eye alone sees are left by rounding and by slopes; nothing of note hides there.
#define LEAST_WIDTH 2

// Whether each pixel of the row belongs to so many, side by side, that one eye alone sees. `stereo_depth`: visibility.h.
static inline mask is_half_occluded(PLANE stereo_depth, Frame f) {
  mask alone[2 * LEAST_WIDTH - 1];
  const int here = index_of(f, FIRST_X, ROW_Y);
  const real depth = load(stereo_depth, here);
  const mask is_alone = (depth > 0) & !is_background(depth);
  if (!ANY(is_alone)) return is_alone;
  for (int k = 0; k < 2 * LEAST_WIDTH - 1; ++k) {
    const int step = k + 1 - LEAST_WIDTH;
    const natural column = to_natural(FIRST_X + IOTA + step);
    alone[k] = (load(stereo_depth, here + step) > 0) & to_mask(column < (natural)((uint)f.width));
  }
  mask is_wide = (mask)(0);
  for (int first = 0; first < LEAST_WIDTH; ++first) {
    mask all = alone[first];
    for (int k = 1; k < LEAST_WIDTH; ++k) all &= alone[first + k];
    is_wide |= all;
  }
  return is_wide & is_alone;
}

#endif
