// Light of an environment from the directions that ambient occlusion leaves open, by the slices of evidence.cl.
//   slices       light on the open surface, less what closed directions of each slice would send (missing_light.h)
//   bent_normal  AO times the light on a surface that faces the mean open direction (Klehm, Ritschel, Eisemann, Seidel 2012)
//   normal       AO times the light on the open surface
//
// in : depth              view-space z, scene units, +inf = background
//      normal             unit, view space
//      occluders, back_depth, coefficients  as evidence.cl
//      environment_light  shared/rays/environment.h
// out: environment_raw    irradiance / pi, in the unit of the map, unfiltered; 0 on background
//      ao_raw, bent_normal, cone  as evidence makes them (WITH_...)
// -D as evidence.cl, with ENVIRONMENT_SIZE, BY_BENT_NORMAL, BY_NORMAL, RAYS
#include "evidence/expected_slices.h"

static inline void store_light(real light, Receiver r, PLANE_OUT plane) {
  write_at(r, choose(r.point.background, (real)(0), larger(light, (real)(0))), plane);
}

#define STORE_OPEN                           \
  store((real)(0), environment_raw_r, here); \
  store((real)(0), environment_raw_g, here); \
  store((real)(0), environment_raw_b, here); \
  STORE_NO_AO_RAW STORE_NO_DIRECTIONS

// in : coefficients, environment_light, depth, normal; occluders, wanted, back_depth, isolated
// out: environment_raw; isolated, ao_raw, bent_normal, cone
kernel void environment_estimate(ARGUMENTS) {
  RECEIVERS(r)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  OpenDirections directions = whole_hemisphere(r.normal);
  Sum mean = no_sum();
  coefficients += WITH_BACK_DEPTH * NUMBERS;
  real3 light = make3((real)(0), (real)(0), (real)(0));
  if (ANY(!r.point.background)) {
    Search search = search_of(params, r);
    search.environment = environment_light;
#if WITH_BACK_DEPTH
    search.back = back_depth;
#endif
    search_around(frame, params, layers, search, coefficients, &mean, &directions);
#if MISSING_LIGHT
    // Slices may expect less than nothing or more than all, as far as the mean does not.
    const real kept = smaller(larger(mean.closed, (real)(0)), (real)(1));
    const real share = quotient(kept, choose(mean.closed != 0, mean.closed, (real)(1)));
    light = light_on_surface(environment_light, r.normal);
    light = make3(light.x - share * mean.missing.x, light.y - share * mean.missing.y, light.z - share * mean.missing.z);
#else
#if BY_BENT_NORMAL
    const real3 towards = bent_normal_of(directions, r.normal);
#else
    const real3 towards = r.normal;
#endif
    const real open = smaller(larger(1 - mean.closed, (real)(0)), (real)(1));
    light = scale3(light_on_surface(environment_light, towards), open);
#endif
  }
  store_light(light.x, r, environment_raw_r);
  store_light(light.y, r, environment_raw_g);
  store_light(light.z, r, environment_raw_b);
  STORE_AO_RAW(1 - mean.closed, r)
  STORE_OPEN_DIRECTIONS(directions, r)
}
