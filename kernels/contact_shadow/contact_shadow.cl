// Contact shadows: whether something near stands between a surface and a light, by samples of the depth along the ray towards the
// light.
//
// in : depth, normal   view-space z, scene units, +inf = background; unit, view space
// out: contact          1: light arrives, 0: it does not, or the surface faces away; 1 on background
// -D STEPS, POINT, JITTER, MASKED
#include "contact_shadow/light_ray.h"
#include "shared/lanes/wanted.h"

// A sample stands for its own pixel, so that what is thinner than a step of the ray is met. (For all that lies between two samples it
// would stand too far: on built-in scenes the RMSE is the same or up to .013 larger.)
#define HALF_A_PIXEL ((scalar)0.5)

// Light arrives where nothing is looked for.
static inline real unshaded(LightRay r) {
  return choose(r.point.background | r.at_light | r.faces, (real)(1), (real)(0));
}

// in : light, depth, normal; wanted
// out: contact
kernel void contact_shadow(ARGUMENTS) {
  const LightRay r = light_ray_at(frame, light, params.length, params.max_reach * (scalar)frame.width, depth, normal_x,
                                  normal_y, normal_z);
  SKIP_UNWANTED(frame, store(unshaded(r), contact, here))
  real shift = noise_at(r.x, (integer)(r.y), frame.seed).shift;
  // Behind its visible front an occluder reaches this far along the pixel's ray.
  const real along_ray = inverse_sqrt(1 + r.point.ray_x * r.point.ray_x + r.point.ray_y * r.point.ray_y);
  const real thickness = (scalar)params.thickness * r.length * along_ray;
  mask searched = is_wanted & !r.point.background & !r.at_light & r.faces, shaded = (mask)(0);
  for (int k = 0; k < STEPS; ++k) {
#if GATHERS_ONLY
    shift += sample_on(r, frame, depth, (real)(((scalar)k + 1) * (scalar)(1.0f / STEPS)), (real)(0)).e;
    continue;
#endif
    if (!ANY(searched)) break;
    const OnRay s = sample_on(r, frame, depth, ((scalar)k + shift) * (scalar)(1.0f / STEPS), (real)(HALF_A_PIXEL));
    const mask stands_before = passes(frame, s, (real)(0), thickness) & rises_by(r, s, params.bias);
    shaded |= searched & stands_before;
    searched &= !stands_before;
  }
#if GATHERS_ONLY
  store(shift, contact, r.here);
  return;
#endif
  store(choose(shaded, (real)(0), unshaded(r)), contact, r.here);
}
