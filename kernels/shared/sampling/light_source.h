// What a pixel sends as a source of light, packed into 64 bits for one gather: its radiance, each component as the upper 16 bits of a
// float (rounded to nearest: relative error below 2^-8, any magnitude), and its normal, folded into an octahedron of 256 x 256 points
// (Cigolle et al. 2014; below half a degree off).
#ifndef GLOAM_LIGHT_SOURCE_H
#define GLOAM_LIGHT_SOURCE_H

#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

typedef struct {
  real3 radiance;
  real3 normal;  // view space, of any length above .5
} LightSource;

static inline natural upper_bits(real v) {
  const natural bits = as_natural(to_stored(v));
  return (bits + 0x7fffu + ((bits >> 16) & 1u)) >> 16;
}

static inline real from_upper_bits(natural bits) { return to_real(as_stored(bits)); }

static inline real fold(real v, real other) { return choose(v < 0, fabs(other) - 1, 1 - fabs(other)); }

static inline natural packed_normal(real3 n) {
  const real scale = (scalar)1 / larger(fabs(n.x) + fabs(n.y) + fabs(n.z), (real)(1e-6f));
  real x = n.x * scale, y = n.y * scale;
  const real folded_x = fold(x, y), folded_y = fold(y, x);
  x = choose(n.z < 0, folded_x, x);
  y = choose(n.z < 0, folded_y, y);
  const natural column = to_natural(to_integer(x * (scalar)127 + (scalar)128.5));
  const natural row = to_natural(to_integer(y * (scalar)127 + (scalar)128.5));
  return column | (row << 8);
}

static inline real3 unpacked_normal(natural bits) {
  real x = (to_real(bits & 0xffu) - 128) * (scalar)(1.0 / 127);
  real y = (to_real((bits >> 8) & 0xffu) - 128) * (scalar)(1.0 / 127);
  const real z = 1 - fabs(x) - fabs(y), behind = larger(-z, (real)(0));
  x -= choose(x < 0, -behind, behind);
  y -= choose(y < 0, -behind, behind);
  return make3(x, y, z);
}

// A colour whose largest component is at most `brightest`. A colour within it keeps its bits.
static inline real3 bounded_radiance(real3 c, scalar brightest) {
  const real largest = larger(kept_radiance(c.x), larger(kept_radiance(c.y), kept_radiance(c.z)));
  const real scale = choose(largest > brightest, brightest / larger(largest, (real)(1e-30f)), (real)(1));
  return make3(kept_radiance(c.x) * scale, kept_radiance(c.y) * scale, kept_radiance(c.z) * scale);
}

// Writes the sources of the row of pixels from index `here` on.
static inline void store_light_source(real3 color, real3 normal, global float* sources, int here) {
  const natural red_green = (upper_bits(kept_radiance(color.x)) << 16) | upper_bits(kept_radiance(color.y));
  const natural blue_normal = (upper_bits(kept_radiance(color.z)) << 16) | packed_normal(normal);
  store_bit_pair(red_green, blue_normal, sources, here);
}

#ifdef LIGHT_R_LAYERS
// Of layers of depth, unpacked: one stack for each component.
typedef struct {
  global const float *r, *g, *b, *normal_x, *normal_y, *normal_z;
  scalar brightest;  // bounded_radiance
} LightSources;

#define LESSER(a, b) ((a) < (b) ? (a) : (b))
// Layers that all components have.
#define SOURCE_LAYERS                                                    \
  LESSER(LESSER(LIGHT_R_LAYERS, LESSER(LIGHT_G_LAYERS, LIGHT_B_LAYERS)), \
         LESSER(LIGHT_NORMAL_X_LAYERS, LESSER(LIGHT_NORMAL_Y_LAYERS, LIGHT_NORMAL_Z_LAYERS)))

static inline int size_of_layer(Frame f) { return 2 * FRAME_GUARD + f.pitch * f.height; }

#else
typedef struct {
  global const float* packed;
} LightSources;
#endif

// The source at an index from `here`.
static inline LightSource light_source(LightSources sources, int here, integer place) {
  LightSource s;
#ifdef LIGHT_R_LAYERS
  s.radiance =
      bounded_radiance(gather3(sources.r + here, sources.g + here, sources.b + here, place), sources.brightest);
  s.normal = gather3(sources.normal_x + here, sources.normal_y + here, sources.normal_z + here, place);
#else
  natural red_green, blue_normal;
  gather_bit_pair(sources.packed + 2 * (size_t)here, place, &red_green, &blue_normal);
  s.radiance = make3(from_upper_bits(red_green & 0xffff0000u), from_upper_bits(red_green << 16),
                     from_upper_bits(blue_normal & 0xffff0000u));
  s.normal = unpacked_normal(blue_normal & 0xffffu);
#endif
  return s;
}

#endif
