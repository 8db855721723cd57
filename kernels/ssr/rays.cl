// Draws rays by the BRDF of each surface (Stachowiak and Uludag 2015; visible normals of GGX, Heitz 2018).
//
// in : depth, normal, roughness, reflectance  reflector.h
// out: ray_x, _y, _z, ray_density, list       ray.h
//      met, met_in_other                      set to MET_NOTHING
// -D RAYS, JITTER, TRAVERSAL, MASKED, MASK_ALONE (reflection-mask: a mirror's ray from every surface)
#include "shared/lanes/pixel_list.h"
#include "shared/lanes/wanted.h"
#include "shared/rays/screen_ray.h"
#include "shared/sampling/sample.h"
#include "ssr/reflector.h"

// Direction of ray k of a pixel, and its density: 0 where the ray would lead below the surface.
static inline real3 ray_of(Reflector s, Noise noise, int k, real* density) {
  // The rays of a pixel follow the R2 sequence (Roberts 2018).
  const real u = noise.shift + k * (scalar)0.7548776662, turn = noise.turn + k * (scalar)0.5698402910;
  real3 h = visible_normal(s.to_eye, s.alpha, u - floor(u), turn - floor(turn));
  const mask is_mirror = s.is_mirror | EVERY_LANE_IF(MASK_ALONE);
  h = choose3(is_mirror, make3((real)(0), (real)(0), (real)(1)), h);
  const real vh = 2 * dot3(s.to_eye, h);
  const real3 l = make3(vh * h.x - s.to_eye.x, vh * h.y - s.to_eye.y, vh * h.z - s.to_eye.z);
  const real per_angle = reflected_density(s.alpha, s.to_eye, h, hidden_per_seen(s.alpha, s.to_eye));
  *density = choose(is_mirror, choose(s.reflects & EVERY_LANE_IF(k == 0), REAL_INFINITY, (real)(0)),
                    choose(s.reflects & (l.z > (scalar)1e-4f), per_angle, (real)(0)));
  return exactly_normalised(out_of_frame(s, l));
}

// in : depth, normal, roughness, reflectance; wanted
// out: list, ray_x, ray_y, ray_z, ray_density, met; met_in_other
kernel void ssr_rays(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const Noise noise = noise_at(FIRST_X + IOTA, (integer)(ROW_Y), frame.seed);
  const mask is_wanted = WANTED_PIXELS(frame, ROW_Y);
  for (int k = 0; k < RAYS; ++k) {
    real density = 0;
    if (ANY(s.reflects & is_wanted)) {
      const real3 direction = ray_of(s, noise, k, &density);
      store(direction.x, layer_of_out(ray_x, frame, k), here);
      store(direction.y, layer_of_out(ray_y, frame, k), here);
      store(direction.z, layer_of_out(ray_z, frame, k), here);
      density = choose(is_wanted & (s.roughness <= params.max_roughness), density, (real)(0));
      append_pixels(list, here + k * floats_of_layer(frame), density > 0);
    }
    store(density, layer_of_out(ray_density, frame, k), here);
    store((real)(0), layer_of_out(met, frame, k), here);
#if TRAVERSAL
    store((real)(0), layer_of_out(met_in_other, frame, k), here);
#endif
  }
}
