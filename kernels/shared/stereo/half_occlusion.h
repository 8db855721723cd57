// Where one eye shows what the other does not: half-occlusion. A surface that the other eye alone sees can only change points
// within the radius of it; other points need no second eye (Shi, Billeter, Eisemann 2022, section 5).
//
// Space is cut into cells as wide as the radius. Every cell within the radius of a half-occluded surface is marked in a hash table
// of floats: 1 where marked. Cells that share a slot are marked together: this costs some points a needless second eye and misses
// none. The table lies in a plane's memory; it belongs to the eye that sees the half-occluded surface.
#ifndef GLOAM_HALF_OCCLUSION_H
#define GLOAM_HALF_OCCLUSION_H

#include "shared/frame/neighbour.h"

// Slots in the table: a power of two that fits a plane.
#define MOST_CELLS (1 << 17)
static inline int bits_of_cells(Frame f) {
  return 31 - (int)clz(min((uint)MOST_CELLS, (uint)f.pitch * (uint)f.height));
}

// Clears the table; launched for all pixels of the image.
static inline void empty_cells(PLANE_OUT cells, Frame f, int here) {
  if (here < FRAME_GUARD + (1 << bits_of_cells(f))) store((real)(0), cells, here);
}

typedef struct {
  integer x, y, z;
} GridCell;

// Cell number along one axis. A radius of 0 or infinity puts everything into few cells: every point uses the other eye.
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

// Slot of a cell in the table.
static inline integer slot_of(Frame f, GridCell c) {
  const natural h = to_natural(c.x) * 0x8da6b343u + to_natural(c.y) * 0xd8163841u + to_natural(c.z) * 0xcb1ab31fu;
  return to_integer(h >> (uint)(32 - bits_of_cells(f))) + FRAME_GUARD;
}

// Marks a cell and its 26 neighbours. Each lane takes some of the 27; the last is marked more than once.
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

// As mark_around, for the cells of the points where a mask holds, once per cell.
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

// Whether a point lies in a marked cell. `p`: in the space of the eye whose table it is.
static inline mask is_near_marked(PLANE cells, Frame f, real3 p, scalar radius) {
  return gather(cells, slot_of(f, grid_cell_of(p, radius))) > 0;
}

// Runs of pixels shorter than this come from rounding and slopes, and hide nothing of note.
#define LEAST_WIDTH 2

// Whether each pixel of the row is in a run of at least LEAST_WIDTH pixels that one eye alone sees. `stereo_depth`: visibility.h.
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
