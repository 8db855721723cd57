// Positions from depth.
//
// in : depth     planar distance, scene units, +inf = background
// out: position  scene units, the world's axes, relative to the camera; 0 on background
#include "shared/both/projection.h"

// in : depth
// out: position
kernel void positions(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here);
  const mask background = is_background(z);
  const real3 v = point_at(projections, to_real(FIRST_X + IOTA), (real)(ROW_Y), choose(background, (real)(1), z));
  const real3 p = position_of_view(projections, v);
  store(choose(background, (real)(0), p.x), position_x, here);
  store(choose(background, (real)(0), p.y), position_y, here);
  store(choose(background, (real)(0), p.z), position_z, here);
}
