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

// What closes a ray: nothing yet, or what sends nothing.
#define NO_SOURCE (-0x7fffffff)
#define DARK_SOURCE (-0x7ffffffe)

// A source as rays hold it: the index of a pixel, and with two eyes whether both see the surface.
#if STEREO
#define SOURCE_AT(place, by_both) (2 * (place) + (by_both))
#define PLACE_OF(source) ((source) >> 1)
#else
#define SOURCE_AT(place, by_both) (place)
#define PLACE_OF(source) (source)
#endif

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
  integer source;  // SOURCE_AT of what closes it; the place is from the pixel's own; NO_SOURCE, DARK_SOURCE
#if STEREO
  real distance;  // squared, of what closes it, scene units
#endif
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
#if STEREO
  ray.distance = 0;
#endif
  return ray;
}

static inline void start_rays(LightRay* rays, real shift, real cosine, real sine, real mass) {
#define START(k) rays[k] = light_ray(k, shift, cosine, sine, mass);
  FOR_EACH_RAY(START)
#undef START
}

// Where the rays of a pixel's first slice lie in their ranges: the nine pixels of any 3 x 3 have the nine ninths (columns 1/3, rows 1/9),
// so that a small filter averages all elevations. Lattices of irrational steps beside those of sample.h read an SSIM lower by up to
// .014.
static inline real shift_of_rays(natural x, natural y, int seed) {
#if JITTER
  return unit_random(x * 0x55555556u + (y * 0x1c71c71du + (uint)seed * 0x3c6ef372u));
#else
  return (real)(0.5f);
#endif
}

// In slice d: moved on by the golden section.
static inline real shift_of_slice(real shift, int d) {
  const real moved = shift + (scalar)d * (scalar)0.6180339887f;
  return moved - floor(moved);
}

// Takes an occluder that reaches from (along, above) to (along_back, back), as seen from the tangent; `back` at most 0: down to it.
// `distance`: squared, scene units.
static inline void follow(LightRay* ray, real along, real above, real along_back, real back, real distance, mask counts,
                          integer source) {
  const mask closes = counts & (along < ray->cotangent * above) & ((back <= 0) | (along_back >= ray->cotangent * back));
  const mask is_first = closes & to_mask(ray->source == NO_SOURCE);
  ray->source = choose_integer(is_first, source, ray->source);
#if STEREO
  ray->distance = choose(is_first, distance, ray->distance);
#endif
}

// Up from the surface's tangent, and along it to a side of its slice, view space.
typedef struct {
  real3 up, out;
} SideAxes;

static inline SideAxes axes_of_side(Slice slice, real3 to_eye, scalar sign) {
  const real3 t = slice.tangent, v = to_eye;
  SideAxes axes;
  axes.up = make3(slice.sine * t.x + slice.cosine * v.x, slice.sine * t.y + slice.cosine * v.y,
                  slice.sine * t.z + slice.cosine * v.z);
  axes.out = make3(sign * (slice.cosine * t.x - slice.sine * v.x), sign * (slice.cosine * t.y - slice.sine * v.y),
                   sign * (slice.cosine * t.z - slice.sine * v.z));
  return axes;
}

// What a side's ray sees, and the share of the pixel's light that it is, 0 where nothing is sent. `importance`: of the slice.
typedef struct {
  LightSource source;
  real share;
} RayLight;

static inline RayLight light_of_ray(real importance, LightRay ray, LightSources sources, int here, SideAxes axes,
                                    mask is_sent) {
  RayLight light;
  light.source = light_source(sources, here, PLACE_OF(choose_integer(is_sent, ray.source, (integer)(0))));
  const real3 n = light.source.normal;
  const mask faces = dot3(n, axes.up) + ray.cotangent * dot3(n, axes.out) < 0;
  light.share = choose(is_sent & faces, importance * ray.weight, (real)(0));
  return light;
}

static inline mask sends(LightRay ray) { return to_mask(ray.source > DARK_SOURCE); }

// Adds what a side's ray sees.
static inline void add_light(real3* light, real importance, LightRay ray, LightSources sources, int here,
                             SideAxes axes) {
  const mask is_sent = sends(ray);
  if (!ANY(is_sent)) return;
  const RayLight seen = light_of_ray(importance, ray, sources, here, axes, is_sent);
  light->x = multiply_add(seen.share, seen.source.radiance.x, light->x);
  light->y = multiply_add(seen.share, seen.source.radiance.y, light->y);
  light->z = multiply_add(seen.share, seen.source.radiance.z, light->z);
}

#endif
