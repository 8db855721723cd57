// Where something within the radius may occlude, from depth and normals alone: the question of OdSSAO (2020), answered
// without a mesh. One pixel stands for each cell of the image. A cell is wanted where any sample around its pixel rises over
// the pixel's tangent plane; the cells around it are wanted too, as their own samples lie elsewhere.
//
// corner_subsample  `frame`: the cells; `other`: the image
//   in : depth, normal       view-space z, scene units, +inf = background; unit, view space
//   out: low_depth, low_normal  of the pixel that stands for each cell: its left top one
// corner_find
//   in : depth, normal       of the pixels that stand for cells
//   out: found               1 where something rises, else 0; 0 on background
// then                       shared/sampling/cells.h
// hidden-mask asks the same about surfaces that the depth hides:
//
// corner_subsample_hidden
//   in : depth, stochastic   stack of OCCLUDERS_LAYERS depths behind the depth, the depth among them, +inf where there is none
//   out: hidden              of the pixels that stand for cells, +inf where the depth itself was drawn
// corner_find
//   in : occluders           the hidden depths, in place of the depth
// -D SCALE (pixels per cell), DIRECTIONS, STEPS, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS
#include "shared/sampling/ambient_occlusion.h"
#include "shared/filter/subsample.h"
#include "shared/sampling/cells.h"
#include "shared/sampling/fan.h"

// in : depth, normal
// out: low_depth, low_normal
kernel void corner_subsample(ARGUMENTS) {
  subsample_surface(frame, other, depth, normal_x, normal_y, normal_z, low_depth, low_normal_x, low_normal_y,
                    low_normal_z);
}

#ifdef OCCLUDERS_LAYERS
// in : depth, stochastic
// out: hidden
kernel void corner_subsample_hidden(ARGUMENTS) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  const integer step = IOTA * (integer)(SCALE);
  const real seen = gather(depth + from, step);
#pragma unroll
  for (int k = 0; k < OCCLUDERS_LAYERS; ++k) {
    const real drawn = gather(layer_of(stochastic, other, k) + from, step);
    store(choose(drawn == seen, REAL_INFINITY, drawn), layer_of_out(hidden, frame, k), to);
  }
}

#define SEARCHED_PLANE global const float *occluders,
#define SEARCHED occluders,
#else
#define SEARCHED_PLANE
#define SEARCHED
#endif

// Squared sine of a sample's elevation over the tangent plane; 0 for samples below it or out of reach.
static inline __attribute__((always_inline)) real squared_sine(Frame frame, Receiver r, integer dx, integer dy,
                                                               real sample, real farthest, mask* is_above) {
  const real3 v = towards_near(frame, r.point, to_real(dx), to_real(dy), relative_depth(r.point, r.depth, sample));
  const real height = fused_dot3(r.normal, v), square = square_of(v);
  *is_above = height > 0;
  return choose(*is_above & (square < farthest), quotient(height * height, square), (real)(0));
}

#ifdef OCCLUDERS_LAYERS
// The largest squared sine of the hidden depths at a sample. Surfaces face the eye, so behind a point below the tangent
// plane everything lies lower still: nothing is read where no lane `asks`.
static inline __attribute__((always_inline)) real hidden_sine(Frame frame, global const float* occluders, Receiver r,
                                                              int within, integer dx, integer dy, real farthest,
                                                              mask asks) {
  real most = 0;
  if (!ANY(asks)) return most;
#pragma unroll
  for (int l = 0; l < OCCLUDERS_LAYERS; ++l) {
    const real hidden = sample_near(layer_of(occluders, frame, l), frame, r.here, within, dx, dy);
    mask is_above;
    most = larger(most, squared_sine(frame, r, dx, dy, hidden, farthest, &is_above));
  }
  return choose(asks, most, (real)(0));
}
#endif

// Whether a sample in any direction rises high enough to count. Of hidden depths only those count that rise higher than the
// visible one. Ends as soon as this holds for every lane.
static inline __attribute__((always_inline)) mask something_rises(Frame frame, Params params, global const float* depth,
                                                                  SEARCHED_PLANE Receiver r, Fan fan, int within) {
  // In units of the pixel's depth. One pixel wider than the radius, since other pixels of the two cells may be nearer to each
  // other; deeper by the range, as far as SSAO lets occluders stand before the point (estimators/ball.h).
  const real radius = quotient((real)(1), sqrt(r.reach.inverse_square)) + (r.point.across_x + r.point.across_y);
  const real farthest = radius * radius * (1 + 4 * params.range * params.range);
  mask rises = r.point.background;
  for (int d = 0; d < DIRECTIONS; ++d) {
    real least = params.least_sine * params.least_sine, found = 0;
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
      mask is_above;
      const real sine =
          squared_sine(frame, r, dx, dy, sample_near(depth, frame, r.here, within, dx, dy), farthest, &is_above);
      const real seen = choose(counts, sine, (real)(0));
#ifdef OCCLUDERS_LAYERS
      least = larger(least, seen);
      found = larger(found, hidden_sine(frame, occluders, r, within, dx, dy, farthest, counts & is_above & !rises));
#else
      found = larger(found, seen);
#endif
    }
    rises |= found > least;
    if (!ANY(!rises)) break;
    turn(&fan);
  }
  return rises & !r.point.background;
}

// in : depth, normal; occluders
// out: found
kernel void corner_find(ARGUMENTS) {
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  mask rises = (mask)(0);
  // Within a radius of 0 lies nothing, not even in the same cell.
  if (params.radius > 0 && ANY(!r.point.background)) {
    const Fan fan = fan_of(r.reach, r.noise);
    LOOK_AROUND(rises, frame, r, r.reach, something_rises(frame, params, depth, SEARCHED r, fan, within))
  }
  store(choose(rises, (real)(1), (real)(0)), found, r.here);
}
