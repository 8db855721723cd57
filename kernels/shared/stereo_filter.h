// The cross-bilateral filter of bilateral.h over what both eyes see around a pixel (Shi, Billeter, Eisemann 2022, section 3.3):
// F and F* are its values in either eye, W and W* the sums of their weights. result = w F + (1 - w) F*, with w =
// smoothstep(0.5 - eta, 0.5, W / (W + W*)): the eye that sees more of the surface decides, and both decide alike.
//
// in : source, depth, normal                    of this eye
//      other_source, other_depth, other_normal  of the other
// out: result                                   filtered; 1 on background
// -D COLUMNS, ROWS
#ifndef GLOAM_STEREO_FILTER_H
#define GLOAM_STEREO_FILTER_H

#include "shared/bilateral.h"
#include "shared/neighbour.h"

// The planes of one eye that a filter reads.
typedef struct {
  global const float *source, *depth, *normal_x, *normal_y, *normal_z;
} FilterPlanes;

// How lanes' pixels of the other eye lie. Along most surfaces they follow one another as this eye's do, but for a step of one
// pixel now and then: then two loads do instead of a gather.
typedef struct {
  integer column, row;  // of each lane
  int first_column, y;  // of the first lane, before the step, and of all
  mask is_further;      // behind the step
} Pixels;

static inline int lowest_lane(integer v) {
#if LANES == 1
  return v;
#else
  int lowest = v.s0;
  const int* lanes = (const int*)&v;
  for (int i = 1; i < LANES; ++i) lowest = min(lowest, lanes[i]);
  return lowest;
#endif
}

// Whether they follow one another in a row. Lanes that do not count are of no matter.
static inline int follow_in_a_row(integer column, integer row, mask counts, Pixels* p) {
  const integer offset = column - (FIRST_X + IOTA);
  const integer which = integer_of(counts);
  p->column = column;
  p->row = row;
  const int lowest = lowest_lane(which ? offset : (integer)(INT_MAX)),
            first_row = lowest_lane(which ? row : (integer)(INT_MAX));
  p->first_column = FIRST_X + lowest;
  p->y = first_row;
  p->is_further = to_mask(offset > lowest);
  return !ANY(counts & to_mask((offset > lowest + 1) | (row != first_row)));
}

// Values at the pixels `dx` to the right of and `dy` below each lane's, which lie in the image where they count.
static inline real value_at(Frame f, global const float* plane, const Pixels* p, int dx, int dy, int in_a_row) {
  if (in_a_row) {
    const int first = index_of(f, p->first_column + dx, p->y + dy);
    return choose(p->is_further, load(plane, first + 1), load(plane, first));
  }
  const integer x = clamp(p->column + dx, (integer)(0), (integer)(f.width - 1));
  const integer y = clamp(p->row + dy, (integer)(0), (integer)(f.height - 1));
  return gather(plane, FRAME_GUARD + y * f.pitch + x);
}

// The pixels around (x, y), which need not be a pixel. Columns and rows outside the image do not count.
static inline __attribute__((always_inline)) void add_taps_at(Frame f, TangentPlane plane, real x, real y, mask is_seen,
                                                              FilterPlanes planes, const Pixels* p, int in_a_row,
                                                              Taps* taps) {
  const real at_centre = (to_real(p->column) - x) * plane.per_column + (to_real(p->row) - y) * plane.per_row;
#if COLUMNS == 0
#pragma unroll
#endif
  for (int j = -ROWS; j <= ROWS; ++j) {
    if (in_a_row && (p->y + j < 0 || p->y + j >= f.height)) continue;
    const mask in_column =
        ROWS == 0 || in_a_row ? is_seen : is_seen & to_mask(to_natural(p->row + j) < (natural)((uint)f.height));
#pragma unroll
    for (int i = -COLUMNS; i <= COLUMNS; ++i) {
      const real step = at_centre + (scalar)i * plane.per_column + (scalar)j * plane.per_row;
      const real3 n =
          make3(value_at(f, planes.normal_x, p, i, j, in_a_row), value_at(f, planes.normal_y, p, i, j, in_a_row),
                value_at(f, planes.normal_z, p, i, j, in_a_row));
      const real weight = window_at(i, COLUMNS) * window_at(j, ROWS) *
                          same_surface(plane, f, step, value_at(f, planes.depth, p, i, j, in_a_row), n);
      const mask in_row =
          COLUMNS == 0 ? in_column : in_column & to_mask(to_natural(p->column + i) < (natural)((uint)f.width));
      add_tap(taps, weight, in_row, value_at(f, planes.source, p, i, j, in_a_row));
    }
  }
}

// 0 below `from`, 1 above `to`, and smooth in between.
static inline real smooth_step(scalar from, scalar to, real value) {
  const scalar width = max(to - from, (scalar)1e-6f);
  const real t = smaller(larger((value - from) * ((scalar)1 / width), (real)(0)), (real)(1));
  return t * t * (3 - 2 * t);
}

kernel void stereo_bilateral(Frame frame, Neighbour neighbour, Params params, PLANE source, PLANE depth, PLANE normal_x,
                             PLANE normal_y, PLANE normal_z, PLANE other_source, PLANE other_depth,
                             PLANE other_normal_x, PLANE other_normal_y, PLANE other_normal_z, PLANE_OUT result) {
  const Frame other = neighbour.frame;
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  const real z = load(depth, here);
  const mask is_surface = !is_background(z);
  const real3 normal = load3(normal_x, normal_y, normal_z, here);
  const scalar distance = params.depth_tolerance * params.radius;
  const TangentPlane plane =
      tangent_plane_at(frame, to_real(x), (real)(y), z, normal, distance, params.normal_tolerance);
  const Taps own = taps_around(frame, plane, x, y, here, source, depth, normal_x, normal_y, normal_z);
  const real mean = own.sum / own.weights;
  real open = mean;
  const Projection there =
      project_into(neighbour, position_at(frame, to_real(x), (real)(y), choose(is_surface, z, (real)(1))), is_surface);
  if (ANY(there.is_seen)) {
    const TangentPlane there_plane = tangent_plane_at(other, there.x, there.y, there.depth, rotated(neighbour, normal),
                                                      distance, params.normal_tolerance);
    FilterPlanes planes;
    planes.source = other_source;
    planes.depth = other_depth;
    planes.normal_x = other_normal_x;
    planes.normal_y = other_normal_y;
    planes.normal_z = other_normal_z;
    Taps taps;
    taps.sum = taps.weights = (real)(0);
    Pixels pixels;
    if (follow_in_a_row(nearest(there.x), nearest(there.y), there.is_seen, &pixels))
      add_taps_at(other, there_plane, there.x, there.y, there.is_seen, planes, &pixels, 1, &taps);
    else
      add_taps_at(other, there_plane, there.x, there.y, there.is_seen, planes, &pixels, 0, &taps);
    // Without a weight of its own, the other eye has nothing to say.
    const mask counts = taps.weights > 0;
    const real found = taps.sum / choose(counts, taps.weights, (real)(1));
    const real w = smooth_step((scalar)0.5 - params.blend, (scalar)0.5 + params.blend, own.weights / (own.weights + taps.weights));
    open = choose(counts, found + w * (mean - found), mean);
  }
  store(choose(is_surface, open, (real)(1)), result, here);
}
#endif
