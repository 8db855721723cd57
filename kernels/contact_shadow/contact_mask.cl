// Where contact shadows can be: surfaces that face the light, with something before them that rises over the tangent plane. One pixel
// stands for each cell of the image; the cells around a cell where something is found are wanted too.
//
// contact_subsample            `frame`: the cells; `other`: the image
//   in : depth, normal         view-space z, scene units, +inf = background; unit, view space
//   out: low_depth, low_normal of the pixel that stands for each cell: its left top one
// contact_find
//   in : depth, normal         of the pixels that stand for cells
//   out: found                 1 where something may stand before the light, else 0; 0 on background
// then                         shared/sampling/cells.h
// -D SCALE (pixels per cell), STEPS, POINT
#include "contact_shadow/light_ray.h"
#include "shared/filter/subsample.h"
#include "shared/sampling/cells.h"

// Where the pixel of a cell faces away from the light by less than this cosine, others of the cell may face it.
#define ROUNDED ((scalar)0.3f)

// in : depth, normal
// out: low_depth, low_normal
kernel void contact_subsample(ARGUMENTS) {
  subsample_surface(frame, other, depth, normal_x, normal_y, normal_z, low_depth, low_normal_x, low_normal_y,
                    low_normal_z);
}

// in : light, depth, normal
// out: found
kernel void contact_find(ARGUMENTS) {
  LightRay r = light_ray_at(frame, light, params.length, params.max_reach * (scalar)frame.width, depth, normal_x,
                            normal_y, normal_z);
  // Pixels of the cell differ by a cell in where they start, and in what stands before their rays.
  const real cell = r.point.across_x + r.point.across_y;
  // What stands before the rays of other pixels may be a few cells deeper or nearer than before this one's.
  const real thickness = (scalar)params.thickness * r.length, farthest = r.length + thickness + 2 * cell;
  r.last = choose(r.last > 0, smaller(r.last + 1, r.line.end), (real)(0));
  const mask searched = !r.point.background & !r.at_light & (r.faces | (r.facing > -ROUNDED));
  const real around = larger((scalar)0.5 * r.last * (scalar)(1.0f / STEPS), (real)(1));
  mask rises = (mask)(0);
  for (int k = 0; k < STEPS; ++k) {
    if (!ANY(searched & !rises)) break;
    const OnRay s = sample_on(r, frame, depth, (real)(((scalar)k + 1) * (scalar)(1.0f / STEPS)), around);
    rises |= searched & passes(frame, s, cell, thickness + 4 * cell) & rises_by(r, s, params.least_sine) &
             (dot3(s.offset, s.offset) < farthest * farthest);
  }
  store(choose(rises, (real)(1), (real)(0)), found, r.here);
}
