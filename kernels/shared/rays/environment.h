// Light of an environment, by direction. The host prefilters a map (technique/environment_light.h) into squares of texels: octahedra of
// directions (Cigolle et al. 2014), unfolded, with a border of one texel.
//
// environment_light  the rotation from view space to the map, 9 numbers row by row, and one that fills up; then 64 bits for each texel: the
//                    light on surfaces by their normal, and levels of radiance, from 8 texels a side to ENVIRONMENT_SIZE
// -D ENVIRONMENT_SIZE
#ifndef GLOAM_ENVIRONMENT_H
#define GLOAM_ENVIRONMENT_H

#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

#define SIZE_ON_SURFACES 32
#define COARSEST_SIZE 8
#define LEVEL_PITCH (ENVIRONMENT_SIZE + 2)
#define NUMBERS_OF_ROTATION 10
// The first texel of the levels.
#define FIRST_OF_LEVELS ((SIZE_ON_SURFACES + 2) * (SIZE_ON_SURFACES + 2))
// Level l has COARSEST_SIZE << l texels a side.
#define FINEST_LEVEL (ENVIRONMENT_SIZE == COARSEST_SIZE ? 0 : 5)  // 256 texels a side

// A direction of view space in the map, at a place of the unfolded octahedron: -1 to 1 each way.
typedef struct {
  real x, y;
} MapPlace;

static inline MapPlace place_in_map(PLANE light, real3 v) {
  const real x = (real)(light[0]) * v.x + (real)(light[1]) * v.y + (real)(light[2]) * v.z;
  const real y = (real)(light[3]) * v.x + (real)(light[4]) * v.y + (real)(light[5]) * v.z;
  const real z = (real)(light[6]) * v.x + (real)(light[7]) * v.y + (real)(light[8]) * v.z;
  const real scale = (scalar)1 / larger(fabs(x) + fabs(y) + fabs(z), (real)(1e-20f));
  const real across = x * scale, down = y * scale;
  const mask is_below = z < 0;
  MapPlace place;
  place.x = choose(is_below, choose(across < 0, fabs(down) - 1, 1 - fabs(down)), across);
  place.y = choose(is_below, choose(down < 0, fabs(across) - 1, 1 - fabs(across)), down);
  return place;
}

// Three floats that are not negative, of 21 bits each.
static inline real3 texel_of_map(PLANE light, integer texel) {
  natural high, low;
  gather_bit_pair(light + NUMBERS_OF_ROTATION, texel, &high, &low);
  return make3(to_real(as_stored((high & 0x7ffffc00u))),
               to_real(as_stored(((high & 0x3ffu) << 21) | ((low >> 21) << 10))),
               to_real(as_stored((low & 0x1fffffu) << 10)));
}

// The mean of the four texels about a place of a square. `size`: texels a side, `first`: index of the square's first texel.
static inline real3 between_texels(PLANE light, MapPlace place, real size, integer first, int pitch) {
  const real x = smaller(larger((place.x + 1) * size * (scalar)0.5 + (scalar)0.5, (real)(0)), size);
  const real y = smaller(larger((place.y + 1) * size * (scalar)0.5 + (scalar)0.5, (real)(0)), size);
  const real left = floor(x), top = floor(y), right = x - left, down = y - top;
  const integer at = first + to_integer(top) * pitch + to_integer(left);
  const real3 a = texel_of_map(light, at), b = texel_of_map(light, at + 1);
  const real3 c = texel_of_map(light, at + pitch), d = texel_of_map(light, at + pitch + 1);
  const real of_a = (1 - right) * (1 - down), of_b = right * (1 - down), of_c = (1 - right) * down, of_d = right * down;
  return make3(of_a * a.x + of_b * b.x + of_c * c.x + of_d * d.x, of_a * a.y + of_b * b.y + of_c * c.y + of_d * d.y,
               of_a * a.z + of_b * b.z + of_c * c.z + of_d * d.z);
}

// Light on an open surface: the mean radiance of cosine-weighted directions about the normal.
static inline real3 light_on_surface(PLANE light, real3 normal) {
  return between_texels(light, place_in_map(light, normal), (real)(SIZE_ON_SURFACES), (integer)(0),
                        SIZE_ON_SURFACES + 2);
}

// Radiance of the coarsest level, whose texels are 22 degrees wide.
static inline real3 coarse_radiance(PLANE light, real3 direction) {
  return between_texels(light, place_in_map(light, direction), (real)(COARSEST_SIZE), (integer)(FIRST_OF_LEVELS),
                        LEVEL_PITCH);
}

// Mean radiance of a cone of directions of about this solid angle, in steradians; 0: as fine as the map is.
static inline real3 radiance_of_cone(PLANE light, real3 direction, real angle) {
  // A texel of the level l has about 4 pi / (COARSEST_SIZE 2^l)^2.
  const real texels = (scalar)(12.566370614 / (COARSEST_SIZE * COARSEST_SIZE)) / larger(angle, (real)(1e-12f));
  integer level = (integer)(0);
  scalar next = 2;
  for (int l = 0; l < FINEST_LEVEL; ++l) {
    level += to_integer(choose(texels > next, (real)(1), (real)(0)));
    next *= 4;
  }
  const integer power = (integer)(1) << level;
  const integer first = FIRST_OF_LEVELS + (COARSEST_SIZE * (power - 1) + 2 * level) * LEVEL_PITCH;
  return between_texels(light, place_in_map(light, direction), to_real(COARSEST_SIZE * power), first, LEVEL_PITCH);
}

#endif
