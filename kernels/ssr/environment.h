// What rays see that find nothing in the image: the same light from everywhere, or with ENVIRONMENT_SIZE that of a map.
#ifndef GLOAM_SSR_ENVIRONMENT_H
#define GLOAM_SSR_ENVIRONMENT_H

#include "ssr/reflector.h"

#ifdef ENVIRONMENT_SIZE
#include "shared/rays/environment.h"

// A ray of a rough surface stands for a cone of directions, as large as there are few rays that a pixel's mean is made of (Krivanek,
// Colbert 2008). `density`: of the ray, +inf for a mirror's.
static inline real3 seen_by_ray(PLANE light, real3 direction, real density, mask counts) {
  const real3 none = make3((real)(0), (real)(0), (real)(0));
  if (!ANY(counts)) return none;
  const real angle = (scalar)(2.0f / (RAYS * NEIGHBOURS)) / larger(density, (real)(1e-3f));
  return radiance_of_cone(light, direction, angle);
}

// The light that a very rough surface shows: about that of a surface that faces between its normal and the mirror direction (Lagarde, de
// Rousiers 2014, section 4.9.3).
static inline real3 seen_by_rough_surface(PLANE light, Reflector s, mask counts) {
  const real3 none = make3((real)(0), (real)(0), (real)(0));
  if (!ANY(counts)) return none;
  const real smoothness = 1 - s.alpha, towards_mirror = smoothness * (sqrt(larger(smoothness, (real)(0))) + s.alpha);
  const real3 mirrored = make3(-s.to_eye.x, -s.to_eye.y, s.to_eye.z);
  const real3 main =
      make3(towards_mirror * mirrored.x, towards_mirror * mirrored.y, 1 + towards_mirror * (mirrored.z - 1));
  return light_on_surface(light, out_of_frame(s, main));
}
#else
static inline real3 even_environment(Params params) {
  return make3((real)(params.environment_r), (real)(params.environment_g), (real)(params.environment_b));
}
#endif

#endif
