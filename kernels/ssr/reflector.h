// The reflecting surface that a pixel shows.
//
// depth      view-space z, scene units, +inf = background
// normal     unit, view space
// roughness  perceptual
// reflectance  at normal incidence
#ifndef GLOAM_SSR_REFLECTOR_H
#define GLOAM_SSR_REFLECTOR_H

#include "shared/frame/camera.h"
#include "shared/rays/ggx.h"

typedef struct {
  Anchor point;
  real depth;
  real3 normal, first, second;  // view space: the surface's frame
  real3 to_eye;                 // in that frame
  real roughness, alpha;
  mask reflects, is_mirror;
} Reflector;

static inline real3 into_frame(Reflector s, real3 v) {
  return make3(dot3(v, s.first), dot3(v, s.second), dot3(v, s.normal));
}

static inline real3 out_of_frame(Reflector s, real3 v) {
  return make3(s.first.x * v.x + s.second.x * v.y + s.normal.x * v.z,
               s.first.y * v.x + s.second.y * v.y + s.normal.y * v.z,
               s.first.z * v.x + s.second.z * v.y + s.normal.z * v.z);
}

// Reflectance at normal incidence, at most 1.
static inline real3 reflectance_at(PLANE r, PLANE g, PLANE b, int here) {
  const real3 f = load3(r, g, b, here);
  return make3(clamp(f.x, (real)(0), (real)(1)), clamp(f.y, (real)(0), (real)(1)), clamp(f.z, (real)(0), (real)(1)));
}

static inline Reflector reflector_of(Frame frame, Params params, int here, PLANE depth, PLANE normal_x, PLANE normal_y,
                                     PLANE normal_z, PLANE roughness, PLANE reflectance_r, PLANE reflectance_g,
                                     PLANE reflectance_b) {
  Reflector s;
  const real z = load(depth, here), x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const real3 n = load3(normal_x, normal_y, normal_z, here);
  const real3 f0 = reflectance_at(reflectance_r, reflectance_g, reflectance_b, here);
  s.roughness = load(roughness, here);
  s.reflects = !is_background(z) & (dot3(n, n) > (scalar)0.25f) & (f0.x + f0.y + f0.z > 0) &
               to_mask(FIRST_X + IOTA < frame.width);
  s.depth = choose(s.reflects, z, (real)(1));
  s.point = anchor_at(frame, x, y, s.depth);
  s.normal = choose3(s.reflects, n, make3((real)(0), (real)(0), (real)(1)));
  tangents_of(s.normal, &s.first, &s.second);
  s.to_eye = into_frame(s, scale3(exactly_normalised(view_ray(frame, x, y)), (real)(-1)));
  // A shading normal may face away from the eye.
  s.to_eye.z = larger(s.to_eye.z, (real)(1e-3f));
  s.to_eye = exactly_normalised(s.to_eye);
  s.is_mirror = s.roughness < MIRROR_ROUGHNESS;
  s.alpha = choose(s.is_mirror, (real)(MIRROR_ROUGHNESS * MIRROR_ROUGHNESS), s.roughness * s.roughness);
  return s;
}

static inline void no_reflection(PLANE_OUT r, PLANE_OUT g, PLANE_OUT b, PLANE_OUT a, int here) {
  store((real)(0), r, here);
  store((real)(0), g, here);
  store((real)(0), b, here);
  store((real)(0), a, here);
}

#endif
