// What an occluder adds if it is the highest one so far in its direction: horizon-based ambient occlusion (Bavoil, Sainz,
// Dimitrov 2008; Vermeer, Scandolo, Eisemann 2021, Algorithm 2).
// -D COSINE_WEIGHTED, NO_FALLOFF, LINEAR_FALLOFF
#ifndef GLOAM_HORIZON_H
#define GLOAM_HORIZON_H

#include "estimators/bent_normal.h"
#include "shared/sampling/slice.h"

// Heights are elevations above the tangent plane, kept as the share of a direction's wedge that lies below: the sine where
// all directions count alike, its square where they count by their cosine to the normal.
#if COSINE_WEIGHTED
#define HEIGHT_OF_SINE(s) ((s) * (s))
#define SINE_OF_HEIGHT(h) sqrt(h)
#else
#define HEIGHT_OF_SINE(s) (s)
#define SINE_OF_HEIGHT(h) (h)
#endif

typedef struct {
  real height, taken;  // 0 to 1: height of the highest occluder; share of the wedge taken, with falloff
} Horizon;

// One sample: its height, 0 or less if out of reach, and the share of the wedge that it takes.
typedef struct {
  real height, taken;
} Rise;

static inline Horizon horizon_from(scalar height) {
  Horizon h;
  h.height = (real)(height);
  h.taken = (real)(0);
  return h;
}

// Weight of an occluder by its squared distance in radii: 0 from the radius on.
static inline real attenuation(real square) {
#if NO_FALLOFF
  return choose(square < 1, (real)(1), (real)(0));
#elif LINEAR_FALLOFF
  return larger(1 - sqrt(square), (real)(0));
#else
  return larger(1 - square, (real)(0));
#endif
}

// The rise to the point at v, where it `counts`. n: unit normal; `inverse_square`: 1 / radius^2 in the units of v.
static inline Rise rise_to(Horizon horizon, real3 v, real3 n, real inverse_square, mask counts) {
  const real vv = square_of(v);
#if COSINE_WEIGHTED
  const real above = larger(fused_dot3(n, v), (real)(0));
  const real height = above * above * quick_inverse(vv);
#else
  const real height = fused_dot3(scale3(n, (scalar)0.5), v) * twice_inverse_sqrt(vv);
#endif
  const real weight = attenuation(vv * inverse_square);
  Rise r;
  r.height = choose(counts & (weight > 0), height, (real)(0));
  // The only dependency between samples.
  r.taken = (larger(r.height, horizon.height) - horizon.height) * weight;
  return r;
}

// Of several layers at a sample the one that takes most; both are measured from the same horizon.
static inline Rise greater_rise(Rise a, Rise b) {
  const mask second = b.taken > a.taken;
  a.height = choose(second, b.height, a.height);
  a.taken = choose(second, b.taken, a.taken);
  return a;
}

// A rise by all layers with what the hidden ones add to the rise `by_first` multiplied by a factor. What is not taken does not
// raise the horizon: it rises by the same share of what the hidden layers add, up to all of it.
static inline Rise compensated_rise(Horizon horizon, Rise all, Rise by_first, scalar factor) {
  const real from = larger(by_first.height, horizon.height), to = larger(all.height, horizon.height);
  all.height = from + min(factor, (scalar)1) * (to - from);
  all.taken = by_first.taken + factor * (all.taken - by_first.taken);
  return all;
}

static inline void raise_by(Horizon* horizon, Rise rise) {
  horizon->height = larger(rise.height, horizon->height);
  horizon->taken += rise.taken;
}

// Takes away the directions of a narrow wedge about the normal n from the tangent plane up to a horizon. t: unit, along the
// tangent plane; `sine`: of the horizon's elevation; `width`: radians. The integral of cosine * (t cosine + n sine).
static inline void take_closed_wedge(OpenDirections* open, real3 t, real3 n, real sine, real width) {
  const real along = width * ((scalar)0.5 * arc_mass(sine)), up = width * ((scalar)0.5 * sine * sine);
  open->sum.x -= t.x * along + n.x * up;
  open->sum.y -= t.y * along + n.y * up;
  open->sum.z -= t.z * along + n.z * up;
  open->weight -= width * sine;
}

#endif
