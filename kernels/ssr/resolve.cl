// Each pixel weighs its neighbours' rays by BRDF / pdf (Stachowiak and Uludag 2015), and with REPROJECTION the other eye's rays
// towards the same virtual image (Wu, Xu, Wang 2024, section 4).
//
// in : depth, normal, roughness, reflectance  reflector.h
//      ray_...             rays.cl and shade.cl, of this eye and, with REPROJECTION, of the other
//      instance            id of what is seen (REPROJECTION)
//      specular_occlusion  open share of the pixel's lobe, a factor on the environment (WITH_SPECULAR_OCCLUSION)
//      environment_light   of a map (environment.h); without ENVIRONMENT_SIZE, params.environment_r, _g, _b
// out: reflection          radiance towards the eye; a = share of it that the image showed
//      reach               mean length of the rays that met something, scene units (TEMPORAL)
// -D RAYS, NEIGHBOURS, OTHER_NEIGHBOURS, REPROJECTION, TEMPORAL, MASKED
#include "shared/lanes/wanted.h"
#include "shared/rays/screen_ray.h"
#include "ssr/environment.h"
#include "ssr/reflector.h"
#if REPROJECTION
#include "ssr/virtual_image.h"
#endif

// Offsets of the pixels around one, the nearest first.
constant char2 around[25] = {{0, 0},  {1, 0},   {-1, 0}, {0, 1},  {0, -1},  {1, 1},   {-1, -1}, {1, -1}, {-1, 1},
                             {2, 0},  {-2, 0},  {0, 2},  {0, -2}, {2, 1},   {-2, -1}, {1, -2},  {-1, 2}, {2, -1},
                             {-2, 1}, {-1, -2}, {1, 2},  {2, 2},  {-2, -2}, {2, -2},  {-2, 2}};

// Weighted sums over rays. Fresnel's term is reflectance + (1 - reflectance) * grazing; the two parts are summed separately and
// combined once.
typedef struct {
  real weights, confidence;
  real3 straight, grazing;  // radiance
  real length, met;         // sums of weight * length and of weight over rays that met something
} Reflected;

// From this length on, in depths, only the direction matters; background counts as this far.
#define FAR_ENOUGH ((scalar)1e4)

// One ray as the passes before found it, of LANES pixels.
typedef struct {
  real3 direction, radiance;
  real length, density, confidence;
} SeenRay;

static inline void take_ray(Reflected* sum, Reflector s, SeenRay ray, mask counts) {
  MAY_FUSE
  const real3 light = into_frame(s, ray.direction);
  const real3 h = make3(light.x + s.to_eye.x, light.y + s.to_eye.y, larger(light.z + s.to_eye.z, (real)(1e-6f)));
  const real share = reflected_share(s.alpha, s.to_eye, light, h, hidden_per_seen(s.alpha, s.to_eye));
  counts &= (light.z > 0) & (ray.density > 0);
  const real w = choose(counts, quotient(share, choose(counts, ray.density, (real)(1))), (real)(0));
  const real grazing = choose(counts, w * grazing_share(dot3(light, h) * inverse_sqrt(dot3(h, h))), (real)(0)),
             straight = w - grazing;
  const real3 radiance = choose3(counts, ray.radiance, make3((real)(0), (real)(0), (real)(0)));
  sum->weights += w;
  sum->confidence += choose(counts, w * ray.confidence, (real)(0));
  sum->length += choose(counts & (ray.length > 0), w * smaller(ray.length, s.depth * FAR_ENOUGH), (real)(0));
  sum->met += choose(counts & (ray.length > 0), w, (real)(0));
  sum->straight = make3(sum->straight.x + straight * radiance.x, sum->straight.y + straight * radiance.y,
                        sum->straight.z + straight * radiance.z);
  sum->grazing = make3(sum->grazing.x + grazing * radiance.x, sum->grazing.y + grazing * radiance.y,
                       sum->grazing.z + grazing * radiance.z);
}

// Direction from the pixel at hand to what another pixel's ray meets. `v`: to that pixel, in depths of the pixel at hand.
static inline real3 towards_met(Reflector s, real3 v, real3 direction, real length) {
  MAY_FUSE
  const real reach = length / s.depth;
  const mask is_near = (reach > 0) & (reach < FAR_ENOUGH);
  const real3 met = make3(v.x + direction.x * reach, v.y + direction.y * reach, v.z + direction.z * reach);
  return choose3(is_near, exactly_normalised(choose3(is_near, met, s.normal)), direction);
}

// Whether a point near the pixel at hand lies on its surface, not before or behind it.
static inline mask on_surface(Reflector s, real3 v) {
  const real height = dot3(v, s.normal);
  return height * height <= (scalar)0.25f * dot3(v, v) + (scalar)1e-6f;
}

#if REPROJECTION
typedef struct {
  global const float *depth, *instance, *x, *y, *z, *r, *g, *b, *length, *density, *confidence;
} OtherRays;

// Each ray is turned to lead from the pixel at hand to what it met, and weighted by the surface's lobe for that direction. Its
// length does not matter: rays of a rough surface meet things near and far. A miss does not count: it tells only that the images
// show nothing there.
static inline void take_rays_of_other(Frame frame, Neighbour n, Reflector s, OtherRays rays, real instance, mask counts,
                                      Reflected* sum) {
  const mask has_met = counts & (sum->met > 0);
  if (!ANY(has_met)) return;
  const real expected = quotient(sum->length, choose(has_met, sum->met, (real)(1)));
  const Projection there = same_virtual_image(frame, n, s, expected, has_met);
  const real3 p = position_at(frame, s.point.x, s.point.y, s.depth);
  const real per_depth = (scalar)1 / s.depth;
  const integer column = nearest(there.x), row = nearest(there.y);
  if (!ANY(there.is_seen)) return;
  for (int i = 0; i < OTHER_NEIGHBOURS; ++i) {
    const integer x = column + (int)around[i].x, y = row + (int)around[i].y;
    const integer inside_x = clamp(x, (integer)(0), (integer)(n.frame.width - 1));
    const integer inside_y = clamp(y, (integer)(0), (integer)(n.frame.height - 1));
    const integer place = FRAME_GUARD + inside_y * n.frame.pitch + inside_x;
    const real z = gather(rays.depth, place);
    const mask is_known = there.is_seen & to_mask((x == inside_x) & (y == inside_y)) & !is_background(z) &
                          (gather(rays.instance, place) == instance);
    if (!ANY(is_known)) continue;
    const real3 q = back_from_other(n, position_at(n.frame, to_real(x), to_real(y), choose(is_known, z, (real)(1))));
    const real3 v = make3((q.x - p.x) * per_depth, (q.y - p.y) * per_depth, (q.z - p.z) * per_depth);
    const mask is_alike = is_known & on_surface(s, v);
    for (int k = 0; k < RAYS; ++k) {
      const integer ray = place + k * floats_of_layer(n.frame);
      SeenRay seen;
      seen.length = gather(rays.length, ray);
      seen.density = gather(rays.density, ray);
      const mask has_hit = is_alike & (seen.length > 0) & !isinf(seen.density);
      if (!ANY(has_hit)) continue;
      const real3 d = gather3(rays.x, rays.y, rays.z, ray);
      const real3 direction = rotated_back(n, d);
      seen.direction = towards_met(s, v, direction, seen.length);
      seen.radiance = gather3(rays.r, rays.g, rays.b, ray);
      seen.confidence = gather(rays.confidence, ray);
      take_ray(sum, s, seen, has_hit);
    }
  }
}
#endif

// in : depth, normal, roughness, reflectance, ray_x, ray_y, ray_z, ray_density, ray_r, ray_g, ray_b, ray_length,
//      ray_confidence; wanted, instance, other_depth, other_instance, other_ray_x, other_ray_y, other_ray_z,
//      other_ray_density, other_ray_r, other_ray_g, other_ray_b, other_ray_length, other_ray_confidence
// out: reflection; reach
kernel void ssr_resolve(ARGUMENTS) {
  SKIP_UNWANTED(frame, no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const real3 none = make3((real)(0), (real)(0), (real)(0));
  const mask is_rough = s.reflects & (s.roughness > params.max_roughness);
  if (!ANY(s.reflects)) {
    no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
    return;
  }
  Reflected sum;
  sum.weights = sum.confidence = sum.length = sum.met = 0;
  sum.straight = sum.grazing = none;
  const int column = FIRST_X;
  for (int i = 0; i < NEIGHBOURS; ++i) {
    const int dx = around[i].x, dy = around[i].y;
    if (ROW_Y + dy < 0 || ROW_Y + dy >= frame.height) continue;
    // A mirror reflects one direction; its neighbours' rays do not help.
    if (i > 0 && !ANY(s.reflects & !s.is_mirror)) break;
    const int there = index_of(frame, column + dx, ROW_Y + dy);
    const integer x = column + dx + IOTA;
    const real z = load(depth, there);
    mask counts = s.reflects & !is_rough & to_mask((x >= 0) & (x < frame.width)) & !is_background(z);
    if (i > 0) counts &= !s.is_mirror;
    const real e = relative_depth(s.point, s.depth, choose(counts, z, s.depth));
    const real3 v = exactly_towards(frame, s.point, s.point.x + dx, s.point.y + dy, e);
    counts &= on_surface(s, v);
    for (int k = 0; k < RAYS; ++k) {
      SeenRay seen;
      seen.density = load(layer_of(ray_density, frame, k), there);
      seen.direction = load3(layer_of(ray_x, frame, k), layer_of(ray_y, frame, k), layer_of(ray_z, frame, k), there);
      seen.length = load(layer_of(ray_length, frame, k), there);
      seen.radiance = load3(layer_of(ray_r, frame, k), layer_of(ray_g, frame, k), layer_of(ray_b, frame, k), there);
      seen.confidence = load(layer_of(ray_confidence, frame, k), there);
      if (i > 0) seen.direction = towards_met(s, v, seen.direction, seen.length);
      // A mirror's own ray has no density: any weight serves.
      const mask is_own = s.is_mirror & EVERY_LANE_IF(i == 0);
      seen.density =
          choose(is_own & (seen.density > 0), (real)(1), choose(isinf(seen.density), (real)(0), seen.density));
      take_ray(&sum, s, seen, counts);
    }
  }
#if REPROJECTION
  const OtherRays others = {other_depth,      other_instance,    other_ray_x,         other_ray_y,
                            other_ray_z,      other_ray_r,       other_ray_g,         other_ray_b,
                            other_ray_length, other_ray_density, other_ray_confidence};
  take_rays_of_other(frame, neighbour, s, others, load(instance, here), s.reflects & !s.is_mirror & !is_rough, &sum);
#endif
#if TEMPORAL
  const mask has_met = sum.met > 0;
  store(choose(has_met, quotient(sum.length, choose(has_met, sum.met, (real)(1))), (real)(0)), reach, here);
#endif
  const mask is_known = (sum.weights > (scalar)1e-12f) & is_wanted;
  const real albedo = choose(s.is_mirror, (real)(1), directional_albedo(s.roughness, s.to_eye.z));
  const real scale = choose(is_known, quotient(albedo, choose(is_known, sum.weights, (real)(1))), (real)(0));
  const real3 f0 = reflectance_at(reflectance_r, reflectance_g, reflectance_b, here);
  // Surfaces too rough for rays reflect the environment, with Fresnel's term for the mirror direction.
  const mask has_environment = is_rough & is_wanted;
#if WITH_SPECULAR_OCCLUSION
  const real reflected = albedo * clamp(load(specular_occlusion, here), (real)(0), (real)(1));
#else
  const real reflected = albedo;
#endif
  const real evenly = choose(has_environment, reflected, (real)(0)), middle = grazing_share(s.to_eye.z);
#ifdef ENVIRONMENT_SIZE
  const real3 environment = seen_by_rough_surface(environment_light, s, has_environment);
#else
  const real3 environment = even_environment(params);
#endif
  // straight + grazing is the whole; Fresnel's term takes `reflectance` of the former and all of the latter.
  store(choose(is_known, scale * (f0.x * sum.straight.x + sum.grazing.x),
               evenly * (f0.x + (1 - f0.x) * middle) * environment.x),
        reflection_r, here);
  store(choose(is_known, scale * (f0.y * sum.straight.y + sum.grazing.y),
               evenly * (f0.y + (1 - f0.y) * middle) * environment.y),
        reflection_g, here);
  store(choose(is_known, scale * (f0.z * sum.straight.z + sum.grazing.z),
               evenly * (f0.z + (1 - f0.z) * middle) * environment.z),
        reflection_b, here);
  store(choose(is_known, mean_up_to_one(sum.confidence, choose(is_known, sum.weights, (real)(1))), (real)(0)), reflection_a, here);
}
