// Light that a rough surface reflects: microfacets distributed after GGX (Walter et al. 2007) with the height-correlated
// masking and shadowing of Smith (Heitz 2014) and Fresnel's term after Schlick (1994). Vectors are unit, in a
// frame whose z is the surface's normal. `alpha` is the square of the perceptual roughness.
#ifndef GLOAM_GGX_H
#define GLOAM_GGX_H

#include "shared/lanes/math.h"

// Below this roughness a surface is a mirror: its lobe is narrower than what float resolves of a direction.
#define MIRROR_ROUGHNESS ((scalar)0.03f)

// Two tangents that make a right-handed frame with a unit vector (Duff et al. 2017).
static inline void tangents_of(real3 n, real3* first, real3* second) {
  const real sign = choose(n.z >= 0, (real)(1), (real)(-1));
  const real a = (scalar)-1 / (sign + n.z), b = n.x * n.y * a;
  *first = make3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  *second = make3(b, sign + n.y * n.y * a, -n.y);
}

// Normal of a microfacet, drawn from those visible from `v` (Dupuy and Benyoub 2023); `u`, `turn`: random numbers, 0 to 1.
static inline real3 visible_normal(real3 v, real alpha, real u, real turn) {
  const real3 w = exactly_normalised(make3(alpha * v.x, alpha * v.y, v.z));
  real cosine, sine;
  cosine_sine_of_turns(turn, &cosine, &sine);
  const real z = (1 - u) * (1 + w.z) - w.z;
  const real r = sqrt(larger(1 - z * z, (real)(0)));
  const real3 h = make3(r * cosine + w.x, r * sine + w.y, z + w.z);
  return exactly_normalised(make3(alpha * h.x, alpha * h.y, larger(h.z, (real)(1e-6f))));
}

// Squared sine of a vector's angle to the normal. Taken from x and y: near the normal 1 - z^2 loses all digits.
static inline real square_of_sine(real3 v) { return v.x * v.x + v.y * v.y; }
static inline real square_of_tangent(real3 v) { return square_of_sine(v) / larger(v.z * v.z, (real)(1e-12f)); }

// Density of microfacets with normal h (any length), per solid angle. Takes no root: in a narrow lobe its last bits would matter.
static inline real ggx_density(real alpha, real3 h) {
  const real square = alpha * alpha, d = square * h.z * h.z + square_of_sine(h), length = dot3(h, h) / d;
  return square * length * length * (scalar)0.31830989f;
}

// Smith's Lambda: the number of hidden microfacets per visible one, seen from direction v.
static inline real hidden_per_seen(real alpha, real3 v) {
  return (scalar)0.5 * (sqrt(1 + alpha * alpha * square_of_tangent(v)) - 1);
}

// Density of directions reflected at `visible_normal`, per solid angle. `hidden_v`: hidden_per_seen of v.
static inline real reflected_density(real alpha, real3 v, real3 h, real hidden_v) {
  return ggx_density(alpha, h) / (4 * v.z * (1 + hidden_v));
}

// The BRDF times the cosine of the light, without Fresnel's term.
static inline real reflected_share(real alpha, real3 v, real3 l, real3 h, real hidden_v) {
  return ggx_density(alpha, h) / (4 * v.z * (1 + hidden_v + hidden_per_seen(alpha, l)));
}

// Fresnel's term is reflectance + (1 - reflectance) * this. `cosine`: between light and microfacet.
static inline real grazing_share(real cosine) {
  const real c = larger(1 - cosine, (real)(0)), square = c * c;
  return square * square * c;
}

// Share of uniform incoming light that leaves in a direction with cosine `nv`, without Fresnel's term: the integral of
// `reflected_share`. A polynomial fitted to 20 000 samples for each of 50 x 65 pairs of roughness and cosine from 0.005 on;
// largest error 0.0063.
static inline real directional_albedo(real roughness, real nv) {
  const real square = roughness * roughness, r = roughness;
  const real t = square / (square + (scalar)1.5f * larger(nv, (real)(0.005f)) + (scalar)1e-9f);
  const real c0 =
      1.00054f + r * (-0.174202f + r * (0.962909f + r * (0.257572f + r * (-5.34213f + r * (real)(2.95733f)))));
  const real c1 = 0.314376f + r * (-0.627495f + r * (-3.70656f + r * (10.9859f + r * (real)(-3.17806f))));
  const real c2 = -5.23678f + r * (4.33505f + r * (-7.86233f + r * (real)(-2.50503f)));
  const real c3 = 14.8633f + r * (-0.838708f + r * (real)(6.91865f));
  const real c4 = -16.5957f + r * (real)(-2.26256f);
  return clamp(c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (real)(6.71764f))))), (real)(0), (real)(1));
}

#endif
