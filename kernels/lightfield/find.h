// The mask: whether anything within the radius rises over a pixel's tangent plane, for the one pixel that stands for each cell.
#ifndef GLOAM_LIGHTFIELD_FIND_H
#define GLOAM_LIGHTFIELD_FIND_H

#include "lightfield/spot.h"
#include "shared/filter/subsample.h"
#include "shared/sampling/cells.h"

// in : depth, normal, position
// out: low_depth, low_normal, low_position
kernel void lightfield_subsample(ARGUMENTS) {
  subsample_surface(frame, other, depth, normal_x, normal_y, normal_z, low_depth, low_normal_x, low_normal_y,
                    low_normal_z);
  subsample_vector(frame, other, position_x, position_y, position_z, low_position_x, low_position_y, low_position_z);
}

// Whether a sample in any direction rises high enough to count. Ends as soon as this holds for every lane.
static inline __attribute__((always_inline)) real something_rises(Frame f, Params params, Surfaces planes,
                                                                  const Spot* s, Fan fan, real farthest, int straight,
                                                                  int within) {
  mask rises = s->point.background;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy, place;
      step_at(fan, k, &dx, &dy);
      const mask counts = place_sample(f, s, within, &dx, &dy, &place);
      real3 v, normal;
      look_at(planes, s, gather(planes.depth + s->here, place), dx, dy, place, straight, &v, &normal);
      const real height = fused_dot3(normal, v), square = square_of(v);
      rises |= counts & (height > 0) & (square < farthest) &
               (height * height > params.least_sine * params.least_sine * square);
    }
    if (!ANY(!rises)) break;
    turn(&fan);
  }
  return choose(rises & !s->point.background, (real)(1), (real)(0));
}

// in : depth, normal, position
// out: found
kernel void lightfield_find(ARGUMENTS) {
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  const Spot s = spot_in_row(frame, projections, planes, normal_x, normal_y, normal_z);
  real rises = 0;
  // Within a radius of 0 lies nothing, not even in the same cell.
  if (params.radius > 0 && ANY(!s.point.background)) {
    const Reach reach = reach_in_image(frame, &s, params.radius, params.max_reach);
    // Wider, since other pixels of the two cells may be nearer to each other. Background is out of any reach.
    const real farthest = 1 / sqrt(reach.inverse_square) + s.point.across_x + s.point.across_y;
    const Fan fan = fan_of(reach, s.noise);
    LOOK_THROUGH(rises, frame, projections, s, reach,
                 something_rises(frame, params, planes, &s, fan, farthest * farthest, straight, within))
  }
  store(rises, found, s.here);
}

#endif
