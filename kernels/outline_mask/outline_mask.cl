// Outline-dependent ambient occlusion (OdSSAO 2020): counts the outlines of objects that contain the visible surface
// (`gloam capture --outlines`); in a corner there are two or more.
//
// in : outline_count  signed crossings with outlines in front of the surface
//      depth          view-space z, +inf = background (outline_ao)
// out: result         1 where the surface lies in at least `least_count` outlines, or the count is below 0, else 0 (outline_mask,
//                     section 3.1)
//                     1 - occlusion there, else 1; 1 on background (outline_ao, section 5, before the filter)
// -D STAND_ALONE, MASKED
#include "shared/frame/camera.h"
#include "shared/lanes/wanted.h"

// A count below 0 comes from an outline that crosses itself, and says nothing but that details are near one another.
static inline mask is_near_others(real count, scalar least_count) { return (count >= least_count) | (count < 0); }

#if STAND_ALONE
// in : outline_count, depth; wanted
// out: result
kernel void outline_ao(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), result, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const mask is_corner = is_near_others(load(outline_count, here), params.least_count);
  const real ao = choose(is_corner, (real)(1 - params.occlusion), (real)(1));
  store(choose(is_background(load(depth, here)) | !is_wanted, (real)(1), ao), result, here);
}
#else
// in : outline_count
// out: result
kernel void outline_mask(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const mask is_corner = is_near_others(load(outline_count, here), params.least_count);
  store(choose(is_corner, (real)(1), (real)(0)), result, here);
}
#endif
