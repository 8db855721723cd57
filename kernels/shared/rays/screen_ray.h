// A ray of view space as a line in the image along which its nearness (1 / depth; orthographic: -depth) changes evenly (McGuire
// and Mara 2014). It is followed from pixel to pixel, or through a hierarchy of cells of which each holds its nearest surface
// (Uludag 2014).
//
// Nearness is relative to the start, in units of the start's: 0 there, -1 at infinity (perspective). So the unit of the scene
// does not matter, and surfaces close to the start are as exact as float is there.
//
// The hierarchy holds the largest nearness of each cell of 2^k x 2^k pixels for levels k = 0 .. LEVELS - 1, and in a second stack
// the smallest, for levels from 1 on (from 0 on where surfaces have backs). Cells lie in tiles of 16 x 16, one tile after another:
// a ray that goes up the image stays within a few pages of memory, where each row of cells would be another page.
#ifndef GLOAM_SCREEN_RAY_H
#define GLOAM_SCREEN_RAY_H

#include "shared/frame/camera.h"

// 1 / depth, or -depth for an orthographic camera: changes evenly along the image of a line or a plane. Background has the least.
static inline real nearness_of(Frame f, real depth) { return f.perspective > 0 ? quotient((real)(1), depth) : -depth; }
static inline scalar nearness_of_background(Frame f) { return f.perspective > 0 ? (scalar)0 : -(scalar)INFINITY; }

typedef struct {
  real x, y;                  // where it starts: pixels, centres at 0.5
  real per_x, per_y;          // pixels per step; the larger one is 1
  real inverse_x, inverse_y;  // steps per pixel
  real slope;                 // nearness per step
  real inverse_slope;         // where the ray leads away from the eye; else 0
  real end;                   // steps to the border of the image, or to infinity
  real steps_per_length;      // steps per length, in depths of the start, for short rays
  real own, unit;             // nearness of the start, and 1 / its unit
  real growth;                // depth gained per length of the ray
  mask reaches_infinity;      // within the image
} ScreenRay;

// A ray from the point seen at (point.x, point.y) at `depth`. `point`: made with that depth; `direction`: unit, view space.
static inline ScreenRay screen_ray_of(Frame f, Anchor point, real depth, real3 direction) {
  ScreenRay r;
  r.x = point.x + (scalar)0.5;
  r.y = point.y + (scalar)0.5;
  r.growth = -direction.z;
  const real across = (direction.x - point.ray_x * r.growth) / point.across_x;
  const real down = -(direction.y - point.ray_y * r.growth) / point.across_y;
  // A ray that stays within its pixel still gets a length in steps: 0 would be divided by.
  r.steps_per_length = larger(larger(fabs(across), fabs(down)), (real)(1e-12f));
  const real per_step = (scalar)1 / r.steps_per_length;
  r.per_x = across * per_step;
  r.per_y = down * per_step;
  r.inverse_x = choose(r.per_x == 0, REAL_INFINITY, (scalar)1 / r.per_x);
  r.inverse_y = choose(r.per_y == 0, REAL_INFINITY, (scalar)1 / r.per_y);
  r.slope = -r.growth * per_step;
  const mask goes_away = r.growth > 0;
  r.inverse_slope = choose(goes_away, (scalar)1 / r.slope, (real)(0));
  const real right = choose(r.per_x >= 0, (real)((scalar)f.width), (real)(0));
  const real bottom = choose(r.per_y >= 0, (real)((scalar)f.height), (real)(0));
  const real to_border = smaller((right - r.x) * r.inverse_x, (bottom - r.y) * r.inverse_y);
  const real to_infinity = f.perspective > 0 ? choose(goes_away, -r.inverse_slope, REAL_INFINITY) : REAL_INFINITY;
  r.reaches_infinity = to_infinity < to_border;
  r.end = smaller(to_border, to_infinity);
  r.own = nearness_of(f, depth);
  r.unit = f.perspective > 0 ? depth : (scalar)1 / depth;
  return r;
}

// Length of the ray after `t` steps, in depths of its start; steps_to: the inverse.
static inline real length_at(Frame f, ScreenRay r, real t) {
  const real u = t / r.steps_per_length;
  return u / larger(1 - f.perspective * r.growth * u, (real)(1e-16f));
}

static inline real steps_to(Frame f, ScreenRay r, real length) {
  return r.steps_per_length * length / larger(1 + f.perspective * r.growth * length, (real)(1e-16f));
}

// Whether the depths of two relative nearnesses differ by more than `share` of the deeper one.
static inline mask is_deeper_by(Frame f, real deeper, real nearer, scalar share) {
  return f.perspective > 0 ? (1 + nearer) > (1 + share) * (1 + deeper) : deeper < nearer - share * (1 - nearer);
}

// Position on a ray.
typedef struct {
  real t;               // steps from its start
  integer column, row;  // pixel
  integer level;        // of the cell at hand
} Place;

// The cell at a position, and where the ray leaves it.
typedef struct {
  integer x, y;         // column and row of the cell in its level
  integer right, down;  // 1 where the ray goes that way
  real out_x, out_y;    // steps at which the ray leaves by a side
  real out;             // by the side that comes first
} Cell;

static inline Cell cell_at(ScreenRay r, Place p) {
  Cell c;
  c.x = p.column >> p.level;
  c.y = p.row >> p.level;
  c.right = integer_of(r.per_x >= 0) & 1;
  c.down = integer_of(r.per_y >= 0) & 1;
  c.out_x = (to_real((c.x + c.right) << p.level) - r.x) * r.inverse_x;
  c.out_y = (to_real((c.y + c.down) << p.level) - r.y) * r.inverse_y;
  c.out = larger(smaller(c.out_x, c.out_y), p.t);
  return c;
}

typedef struct {
  global const float* nearness;
  global const float* farness;
} Hierarchy;

static inline Hierarchy hierarchy_of(global const float* nearness, global const float* farness) {
  Hierarchy h;
  h.nearness = nearness;
  h.farness = farness;
  return h;
}

// Where a level starts in its stack: after the rows of the levels before, each half as many as in the one before and up to 16 more, to
// fill its tiles. So a stack has twice the image's rows and 16 for each level.
// `type`: of the level, an int or one in each lane.
#define START_OF_LEVEL(image, type, level) \
  (((type)(2 * (image).height) - ((type)(2 * (image).height) >> (level)) + ((level) << 4)) * (image).pitch)

static inline int floats_of_layer(Frame image) { return 2 * FRAME_GUARD + image.pitch * image.height; }

// log2 of the rows of a tile; an image of few rows has tiles of one row.
static inline int tile_rows_shift(Frame image) { return image.height < 16 ? 0 : 4; }

// Index of cell (x, y) from the start of its level. The 16 cells of a tile's row follow one another.
static inline integer index_in_tiles(Frame image, integer x, integer y) {
  const int shift = tile_rows_shift(image);
  const integer tile = (y >> shift) * (image.pitch >> 4) + (x >> 4);
  return (tile << (shift + 4)) + ((y & ((1 << shift) - 1)) << 4) + (x & 15);
}

static inline int index_of_tile_row(Frame image, int x, int y) {
  const int shift = tile_rows_shift(image);
  return (((y >> shift) * (image.pitch >> 4) + (x >> 4)) << (shift + 4)) + ((y & ((1 << shift) - 1)) << 4) + (x & 15);
}

// The largest nearness in a cell; farthest_in: the smallest.
static inline real nearest_in(Frame f, Hierarchy h, Place p, Cell c) {
  return gather(h.nearness, START_OF_LEVEL(f, integer, p.level) + index_in_tiles(f, c.x, c.y));
}

static inline real farthest_in(Frame f, Hierarchy h, Place p, Cell c) {
  return gather(h.farness, START_OF_LEVEL(f, integer, p.level) + index_in_tiles(f, c.x, c.y));
}

// Nearness relative to the ray's start, in the ray's units.
static inline real relative_nearness(ScreenRay r, real nearness) { return (nearness - r.own) * r.unit; }

static inline integer within_cell(integer pixel, integer cell, integer level) {
  return clamp(pixel, cell << level, ((cell + 1) << level) - 1);
}

// The first pixel of the next cell. Whole numbers decide which: rounding neither stops the ray nor makes it skip a cell.
static inline Place leave_cell(ScreenRay r, Place p, Cell c, int top) {
  const integer by_x = integer_of(c.out_x <= c.out_y);
  const integer beside = ((c.x + c.right) << p.level) - (1 - c.right),
                below = ((c.y + c.down) << p.level) - (1 - c.down);
  const integer column = within_cell(to_integer(r.x + r.per_x * c.out), c.x, p.level);
  const integer row = within_cell(to_integer(r.y + r.per_y * c.out), c.y, p.level);
  Place next;
  next.t = c.out;
  next.column = by_x ? beside : column;
  next.row = by_x ? row : below;
  // Goes up a level where the ray leaves the cell of the next level too.
  const integer leaves = ((next.column ^ p.column) | (next.row ^ p.row)) >> (p.level + 1);
  next.level = leaves != 0 ? min(p.level + 1, (integer)(top)) : p.level;
  return next;
}

// Goes down a level, at the point where the ray comes down to the nearest surface.
static inline Place enter_cell(ScreenRay r, Place p, Cell c, real nearest) {
  Place next;
  next.t = clamp(nearest * r.inverse_slope, p.t, c.out);
  next.column = within_cell(to_integer(r.x + r.per_x * next.t), c.x, p.level);
  next.row = within_cell(to_integer(r.y + r.per_y * next.t), c.y, p.level);
  next.level = p.level - 1;
  return next;
}

#endif
