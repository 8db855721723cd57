// The part of a column of the half ball above a surface that lies behind the surface that the screen shows there (Loos, Sloan
// 2010, line samples). Columns run along the line to the eye. A place on a column is given as its height above the surface's
// tangent plane (ball.h), which grows evenly towards the eye.
#ifndef GLOAM_COLUMN_H
#define GLOAM_COLUMN_H

#include "estimators/ball.h"

// Heights, units of the pixel's depth.
typedef struct {
  real low, high;
} Column;

// The part of a column above the tangent plane. `middle`: height of its middle; `half_rise`: from there to the sphere.
static inline Column part_above(real middle, real half_rise) {
  Column c;
  c.low = larger(middle - half_rise, (real)(0));
  c.high = larger(middle + half_rise, (real)(0));
  return c;
}

// Length of the column below a surface of this height.
static inline real below(Column c, real height) { return smaller(larger(height, c.low), c.high) - c.low; }

// Height of a surface at relative depth e; `there` and `fall`: ball.h. A ray that does not fall towards the plane is treated
// as one along the column.
static inline real surface_height(real e, real fall, real there, Heights h) {
  return multiply_add(e, choose(fall < 0, fall, h.fall), there);
}

#endif
