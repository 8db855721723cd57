// Where a surface reflects something that the image shows (technique reflection-mask).
//
// in : roughness         perceptual
//      ray_density, met  ray.h
// out: found             1 or 0
#include "ssr/ray.h"

// 1 where a surface's mirror ray meets something, or where the surface is so rough that this ray alone does not tell.
// in : roughness, ray_density, met
// out: found
kernel void ssr_found(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real rough = load(roughness, here);
  const mask reflects = load(ray_density, here) > 0;
  const mask meets = to_mask(met_in_row(met, here) != MET_NOTHING);
  store(choose(reflects & (meets | (rough > params.blurred)), (real)(1), (real)(0)), found, here);
}
