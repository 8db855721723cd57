// One reflectance for all surfaces, for frames that have none: that of a dielectric.
//
// in : depth        view-space z, +inf = background
// out: reflectance  at normal incidence, 0 to 1; 0 on background
#include "shared/frame/camera.h"

// in : depth
// out: reflectance
kernel void dielectric(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real f0 = choose(is_background(load(depth, here)), (real)(0), (real)(params.reflectance));
  store(f0, reflectance_r, here);
  store(f0, reflectance_g, here);
  store(f0, reflectance_b, here);
}
