// How far a neighbouring pixel shows the same surface, for filters that stop at edges (Petschnigg et al. 2004, Eisemann
// and Durand 2004): by its distance from the pixel's tangent plane and by the angle between the normals.
#ifndef GLOAM_SURFACE_H
#define GLOAM_SURFACE_H

#include "shared/camera.h"
#include "shared/math.h"

typedef struct {
  real per_distance;  // 1 over the distance at which a neighbour no longer counts, in units of the pixel's depth
  real per_cosine;    // 1 over (1 - cosine) at which it no longer counts
} Tolerance;

// `distance`: scene units; `angle`: radians, 0 to pi.
static inline Tolerance tolerance_of(Anchor a, scalar distance, scalar angle) {
  Tolerance t;
  t.per_distance = (scalar)1 / larger(distance * a.inverse_depth, (real)(1e-18f));
  real cosine, unused;
  cosine_sine_of_turns((real)(angle * (scalar)0.15915494309189535), &cosine, &unused);
  t.per_cosine = (scalar)1 / larger(1 - cosine, (real)(1e-7f));
  return t;
}

// 1 on the same plane with the same normal, 0 from the tolerances on. v: vector to the neighbour (`towards`); n, there:
// the pixel's normal and the neighbour's.
static inline real same_surface(Tolerance t, real3 v, real3 n, real3 there) {
  const real by_distance = larger(1 - fabs(dot3(n, v)) * t.per_distance, (real)(0));
  const real by_angle = larger(1 - (1 - dot3(n, there)) * t.per_cosine, (real)(0));
  return by_distance * by_angle;
}

#endif
