// Light that one side of a slice sends to the pixel. A few directions on each side are followed: each sees the first surface that
// closes it (Therrien, Levesque, Gilet 2023, section 3.3, takes the sectors that a sample is the first to close; a direction stands for a
// range of sectors, so that light is read once for each range and not at each sample). A surface that shows the pixel its back sends
// nothing.
// -D RAYS: directions on each side; LIGHT_R_LAYERS ... NORMAL_Z_LAYERS: layers of depth whose light is known (light_source.h)
#ifndef GLOAM_LIGHT_H
#define GLOAM_LIGHT_H

#include "shared/sampling/light_source.h"
#include "shared/sampling/sample.h"
#include "shared/sampling/slice.h"
#include "shared/sampling/slice_rays.h"

// What closes a ray: nothing yet, or what sends nothing.
#define NO_SOURCE (-0x7fffffff)
#define DARK_SOURCE (-0x7ffffffe)

// The source that layer `layer` behind the first sends from an index.
#ifdef LIGHT_R_LAYERS
#define SOURCE_BEHIND(frame, place, layer) \
  ((layer) + 1 < SOURCE_LAYERS ? (place) + ((layer) + 1) * size_of_layer(frame) : (integer)(DARK_SOURCE))
#else
#define SOURCE_BEHIND(frame, place, layer) (integer)(DARK_SOURCE)
#endif

// DO(0) DO(1) ... for each ray. Written out, since arrays that a loop indexes stay in memory.
#if RAYS == 1
#define FOR_EACH_RAY(DO) DO(0)
#elif RAYS == 2
#define FOR_EACH_RAY(DO) DO(0) DO(1)
#elif RAYS == 3
#define FOR_EACH_RAY(DO) DO(0) DO(1) DO(2)
#else
#define FOR_EACH_RAY(DO) DO(0) DO(1) DO(2) DO(3)
#endif

// A direction on one side of a slice.
typedef struct {
  real cotangent;  // of its elevation above the tangent
  real weight;     // the share of the slice's mass that it stands for
  integer source;  // index of what closes it, from the pixel's own; NO_SOURCE, DARK_SOURCE
} LightRay;

// Ray k of a side to which the normal leans by (cosine, sine). `shift`: 0 to 1, its place in its range.
// With the cosine c of the elevation, the mass between c and c + dc is 2 J dc, where J = cosine c + sine sqrt(1 - c^2) falls from
// `cosine` at the tangent to 0 at the line to the eye, nearly along a straight line. So c + sine is drawn as the root of an even number,
// and the weight holds what J differs by.
static inline LightRay light_ray(int k, real shift, real cosine, real sine, real mass) {
  const real root = sqrt(((scalar)k + larger(shift, (real)(1e-3f))) * (scalar)(1.0f / RAYS));
  const real c = multiply_add(1 + sine, root, -sine), above = sqrt(larger(1 - c * c, (real)(1e-12f)));
  const real measure = cosine * c + sine * above;
  LightRay ray;
  ray.cotangent = c / above;
  ray.weight = larger(measure, (real)(0)) * (1 + sine) / root * (scalar)(0.5f / RAYS) * quick_inverse(mass);
  ray.source = (integer)(NO_SOURCE);
  return ray;
}

static inline void start_rays(LightRay* rays, real shift, real cosine, real sine, real mass) {
#define START(k) rays[k] = light_ray(k, shift, cosine, sine, mass);
  FOR_EACH_RAY(START)
#undef START
}

// Takes an occluder that reaches from (along, above) to (along_back, back), as seen from the tangent; `back` at most 0: down to it.
static inline void follow(LightRay* ray, real along, real above, real along_back, real back, mask counts,
                          integer source) {
  const mask closes = counts & (along < ray->cotangent * above) & ((back <= 0) | (along_back >= ray->cotangent * back));
  ray->source = choose_integer(closes & to_mask(ray->source == NO_SOURCE), source, ray->source);
}

// Adds what a side's ray sees. `importance`: of the slice. `up`, `out`: up from the tangent and along it, view space.
static inline void add_light(real3* light, real importance, LightRay ray, LightSources sources, int here, real3 up,
                             real3 out) {
  const mask is_sent = to_mask(ray.source > DARK_SOURCE);
  if (!ANY(is_sent)) return;
  const LightSource source = light_source(sources, here, choose_integer(is_sent, ray.source, (integer)(0)));
  const real share = choose(is_sent & (dot3(source.normal, up) + ray.cotangent * dot3(source.normal, out) < 0),
                            importance * ray.weight, (real)(0));
  light->x = multiply_add(share, source.radiance.x, light->x);
  light->y = multiply_add(share, source.radiance.y, light->y);
  light->z = multiply_add(share, source.radiance.z, light->z);
}

#endif
