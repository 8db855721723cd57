// What one occluder contributes in Alchemy (McGuire, Osman, Bukowski, Hennessy 2011) and in Scalable Ambient Obscurance
// (McGuire, Mara, Luebke 2012): its height above the tangent plane over its squared distance, so that neither a square
// root nor a direction is needed.
#ifndef GLOAM_ALCHEMY_H
#define GLOAM_ALCHEMY_H

#include "shared/sampling/sample.h"

// Constants of the falloff at a pixel, made from the radius. Lengths are in units of the pixel's depth.
typedef struct {
  real radius;
  real epsilon;         // added to squared distances
  real limit;           // squared radius + epsilon
  real inverse_square;  // 1 / radius^2
  scalar beginning;     // 1 + epsilon / radius^2, where the fade begins
} Falloff;

// `epsilon`: squared radii.
static inline Falloff falloff_of(Reach reach, scalar epsilon) {
  Falloff f;
  const real square = quick_inverse(reach.inverse_square);
  f.inverse_square = reach.inverse_square;
  f.radius = square * sqrt(reach.inverse_square);
  // A value far below any squared distance that counts keeps the point itself from 0/0.
  f.epsilon = multiply_add((real)(epsilon), square, (real)(1e-30f));
  f.limit = square + f.epsilon;
  f.beginning = 1 + epsilon;
  return f;
}

// v.v + epsilon
static inline real padded_square(real3 v, Falloff f) {
  return multiply_add(v.x, v.x, multiply_add(v.y, v.y, multiply_add(v.z, v.z, f.epsilon)));
}

// max(0, v.n - bias) / square. `bias`: units of the depth.
static inline real height_over(real square, real3 v, real3 n, scalar bias) {
  const real height = multiply_add(n.x, v.x, multiply_add(n.y, v.y, multiply_add(n.z, v.z, (real)(-bias))));
  return larger(height, (real)(0)) * quick_inverse(square);
}

// The two contributions below are still to be multiplied by the radius.

// Alchemy's: occluders within the radius count in full.
static inline real obscurance_alchemy(real3 v, real3 n, scalar bias, Falloff f) {
  const real square = padded_square(v, f);
  return choose(square < f.limit, height_over(square, v, n, bias), (real)(0));
}

// Fades to 0 at the radius by (1 - v.v / radius^2)^3: of the contributions in the published source of Scalable Ambient
// Obscurance the one that its authors recommend.
static inline real obscurance_scalable(real3 v, real3 n, scalar bias, Falloff f) {
  const real square = padded_square(v, f);
  const real fade = larger(multiply_add(-square, f.inverse_square, (real)(f.beginning)), (real)(0));
  return fade * fade * fade * height_over(square, v, n, bias);
}

#endif
