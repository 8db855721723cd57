// Bent normal: mean of the open directions, weighted by solid angle. Cone: the cone about it that is as open as the directions
// are (Klehm, Ritschel, Eisemann, Seidel 2012, sections 3.1 and 3.2).
// -D BY_BENT_NORMAL: for a kernel's own use
// -D WITH_BENT_NORMAL, WITH_CONE, WITH_SPECULAR_OCCLUSION_RAW, WITH_LOBE_WEIGHT (glossy_lobe.h): a kernel's last line is
//   STORE_OPEN_DIRECTIONS(directions, receiver)
// With the last two it reads `roughness`, and has the line SET_LOBE(directions, receiver).
#ifndef GLOAM_BENT_NORMAL_H
#define GLOAM_BENT_NORMAL_H

#include "shared/rays/ggx.h"
#include "shared/sampling/ambient_occlusion.h"

#define WITH_OPEN_DIRECTIONS (WITH_BENT_NORMAL || WITH_CONE || BY_BENT_NORMAL)
#define WITH_LOBE (WITH_SPECULAR_OCCLUSION_RAW || WITH_LOBE_WEIGHT)

typedef struct {
  real3 sum;
  real weight;
#if WITH_LOBE
  real alpha, lobe_closed, lobe;  // closed and all of the surface's lobe
#endif
} OpenDirections;

static inline OpenDirections no_directions(void) {
  OpenDirections d;
  d.sum = make3((real)(0), (real)(0), (real)(0));
  d.weight = (real)(0);
  return d;
}

// All of the hemisphere about the normal (unit). The closed directions are then taken away, so that an open surface is exact
// with any number of samples.
static inline OpenDirections whole_hemisphere(real3 normal) {
  OpenDirections d;
  d.sum = scale3(normal, (real)((scalar)3.14159265358979));
  d.weight = (real)((scalar)6.28318530717959);
  return d;
}

// `direction`: unit. `weight`: its solid angle; 0 where it is closed, negative to take it away.
static inline void add_open(OpenDirections* d, real3 direction, real weight) {
  d->sum.x += weight * direction.x;
  d->sum.y += weight * direction.y;
  d->sum.z += weight * direction.z;
  d->weight += weight;
}

// The normal where nothing is open.
static inline real3 bent_normal_of(OpenDirections d, real3 normal) {
  const real square = dot3(d.sum, d.sum);
  const mask is_there = square > (scalar)1e-12f;
  return choose3(is_there, scale3(d.sum, inverse_sqrt(choose(is_there, square, (real)(1)))), normal);
}

// Cosine of the cone's half angle: directions spread evenly over a cap of that size have a mean of length (1 + cosine) / 2.
// 0 where a whole hemisphere is open, 1 where nothing is.
static inline real cone_of(OpenDirections d) {
  const real length = sqrt(dot3(d.sum, d.sum)), cosine = quotient(2 * length, larger(d.weight, (real)(1e-12f))) - 1;
  return choose(d.weight > (scalar)1e-6f, smaller(larger(cosine, (real)(0)), (real)(1)), (real)(1));
}

#if WITH_BENT_NORMAL
#define STORE_BENT_NORMAL(d, r) store_bent_normal(d, r, bent_normal_x, bent_normal_y, bent_normal_z);
#define STORE_NO_BENT_NORMAL             \
  store((real)(0), bent_normal_x, here); \
  store((real)(0), bent_normal_y, here); \
  store((real)(0), bent_normal_z, here);
#else
#define STORE_BENT_NORMAL(d, r)
#define STORE_NO_BENT_NORMAL
#endif
#if WITH_CONE
#define STORE_CONE(d, r) write_at(r, choose((r).point.background, (real)(0), cone_of(d)), cone);
#define STORE_NO_CONE store((real)(0), cone, here);
#else
#define STORE_CONE(d, r)
#define STORE_NO_CONE
#endif
#if WITH_LOBE
#define SET_LOBE(d, r) set_lobe(&d, read_at(r, roughness));

static inline void set_lobe(OpenDirections* d, real roughness) {
  const real r = clamp(roughness, (real)(MIRROR_ROUGHNESS), (real)(1));
  d->alpha = r * r;
  d->lobe_closed = d->lobe = (real)(0);
}

static inline real open_lobe_of(OpenDirections d) {
  const mask is_there = d.lobe > 0;
  return larger(1 - quotient(choose(is_there, d.lobe_closed, (real)(0)), choose(is_there, d.lobe, (real)(1))), (real)(0));
}
#else
#define SET_LOBE(d, r)
#endif
#if WITH_SPECULAR_OCCLUSION_RAW
#define STORE_OPEN_LOBE(d, r) \
  write_at(r, choose((r).point.background, (real)(1), open_lobe_of(d)), specular_occlusion_raw);
#define STORE_NO_OPEN_LOBE store((real)(1), specular_occlusion_raw, here);
#else
#define STORE_OPEN_LOBE(d, r)
#define STORE_NO_OPEN_LOBE
#endif
#if WITH_LOBE_WEIGHT
#define STORE_LOBE_WEIGHT(d, r) write_at(r, choose((r).point.background, (real)(0), (d).lobe), lobe_weight);
#define STORE_NO_LOBE_WEIGHT store((real)(0), lobe_weight, here);
#else
#define STORE_LOBE_WEIGHT(d, r)
#define STORE_NO_LOBE_WEIGHT
#endif
#define STORE_OPEN_DIRECTIONS(d, r) \
  STORE_BENT_NORMAL(d, r) STORE_CONE(d, r) STORE_OPEN_LOBE(d, r) STORE_LOBE_WEIGHT(d, r)
// For pixels that are left out (SKIP_UNWANTED), at index `here`.
#define STORE_NO_DIRECTIONS STORE_NO_BENT_NORMAL STORE_NO_CONE STORE_NO_OPEN_LOBE STORE_NO_LOBE_WEIGHT

// Zero on background.
static inline void store_bent_normal(OpenDirections d, Receiver r, PLANE_OUT x, PLANE_OUT y, PLANE_OUT z) {
  // Chosen, not multiplied by 0: a negative number times 0 is -0.
  const real3 nothing = make3((real)(0), (real)(0), (real)(0));
  const real3 bent = choose3(r.point.background, nothing, bent_normal_of(d, r.normal));
  write_at(r, bent.x, x);
  write_at(r, bent.y, y);
  write_at(r, bent.z, z);
}

#endif
