// Ambient occlusion for light-field displays (Doronin, Kara, Barsi, Martini 2017). A display's module has no single centre of
// projection: no matrix leads from its image and depths back to points. So points are read from the plane `position`, and only
// the map from points to pixels is used (Algorithm 2; shared/both/projection.h). With a camera's map, the results are `ssao` and
// `hbao+`.
//
// lightfield_estimate: with ESTIMATE 1 the share of the points in a ball around the pixel's point that lie behind what the image
//   shows, of several radii (section 6, after Hoang, Low 2010) the one that takes most; with 2 the mean obscurance over directions
//   x steps in the image
// in : depth     planar distance, scene units, +inf = background
//      normal    unit, view space
//      position  scene units, the world's axes
//      points    points of the balls, SAMPLES for each of RADII (points.h)
// out: ao_raw    1 = open .. 0 = closed, unfiltered; 1 on background
// ..._list: for the pixels of a list (shared/lanes/pixel_list.h)
//
// lightfield_find: where something within the radius may occlude, as in `corner-mask`, for one pixel of each cell
// in : depth, normal, position  of the pixels that stand for cells (lightfield_subsample)
// out: found     1 where something rises over the tangent plane, else 0; 0 on background; then shared/sampling/cells.h
//
// lightfield_reuse: AO from key views that show the same points
// in : key_depth, key_position, key_ao      of the nearest key view; far_...: of the next one on the other side
// out: ao_raw    mean over the key views that show the point, weighted by `share` (projection.h). Where none does: 1, and the pixel
//                joins `newly_visible`
// -D ESTIMATE (1: ssao, 2: hbao+, 3: the mask), REUSE, FROM_BOTH, MASKED (wanted.h), OUTSIDE_OPEN, JITTER,
//    SCALE (pixels per cell); SAMPLES, RADII, HEMISPHERE, OWN_POINTS, SINGLE_POINTS; DIRECTIONS, STEPS, NO_FALLOFF
#include "shared/sampling/ambient_occlusion.h"
#include "lightfield/spot.h"
#if ESTIMATE > 1
#include "shared/sampling/fan.h"
#endif
#if ESTIMATE == 1
#include "lightfield/ssao.h"
#elif ESTIMATE == 2
#include "lightfield/hbao_plus.h"
#else
#include "lightfield/find.h"
#endif
#if REUSE
#include "lightfield/reuse.h"
#endif

#if ESTIMATE < 3
static inline real open_or_background(const Spot* s, real open) {
  return choose(s->point.background, (real)(1), smaller(larger(open, (real)(0)), (real)(1)));
}

// in : depth, normal, position; wanted, points
// out: ao_raw
kernel void lightfield_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  Spot s = spot_in_row(frame, projections, planes, normal_x, normal_y, normal_z);
  s.point.background |= !is_wanted;
  real open = 1;
  if (ANY(!s.point.background)) open = OPEN_SHARE(frame, projections, params, planes, s);
  store(open_or_background(&s, open), ao_raw, s.here);
}

#if REUSE
// in : depth, normal, position, newly_visible; points
// out: ao_raw
kernel void lightfield_estimate_list(ARGUMENTS) {
  integer index;
  if (!pixels_of_item(newly_visible, frame, &index)) return;
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  const Spot s = spot_of_list(frame, projections, planes, normal_x, normal_y, normal_z, index);
  const real open = OPEN_SHARE(frame, projections, params, planes, s);
  scatter(open_or_background(&s, open), ao_raw, index);
}
#endif
#endif
