// How far a neighbouring pixel shows the same surface, for edge-preserving filters (Petschnigg et al. 2004, Eisemann and
// Durand 2004): by its distance from the pixel's tangent plane and by the angle between the normals.
#ifndef GLOAM_SURFACE_H
#define GLOAM_SURFACE_H

#include "shared/frame/camera.h"
#include "shared/lanes/math.h"

// A pixel's tangent plane, in units of the tolerances. It is made in scene units, so that a pixel costs no division; depths
// are only used as differences, so that a plane stays flat.
typedef struct {
  real depth;
  real per_depth;            // distance from the plane per unit of depth along the pixel's own ray
  real per_column, per_row;  // distance per pixel to the right and down, where pixels are 1 wide
  real3 normal;              // per (1 - cosine) at which a neighbour no longer counts
  scalar square;             // `agreement` of a normal at a right angle
} TangentPlane;

// 1 - cosine of an angle, 0 to pi. The same bits everywhere; error below 2e-7.
static inline scalar one_minus_cosine(scalar angle) {
  const scalar a = (scalar)0.5 * angle, b = a * a;
  const scalar sine =
      a * (1 + b * ((scalar)(-1.0 / 6) +
                    b * ((scalar)(1.0 / 120) +
                         b * ((scalar)(-1.0 / 5040) + b * ((scalar)(1.0 / 362880) + b * (scalar)(-1.0 / 39916800))))));
  return 2 * sine * sine;
}

// `distance` from the plane (scene units) and `angle` between the normals (radians, 0 to pi) at which a neighbour no longer
// counts.
static inline TangentPlane tangent_plane_at(Frame f, real x, real y, real depth, real3 normal, scalar distance,
                                            scalar angle) {
  TangentPlane p;
  // With a tolerance of 0, exactly coplanar neighbours still count.
  const scalar per_distance = distance > (scalar)1e-20f ? (scalar)1 / distance : (scalar)1e20f;
  const scalar allowed = one_minus_cosine(angle);
  const scalar per_cosine = (scalar)1 / (allowed > (scalar)1e-6f ? allowed : (scalar)1e-6f);
  p.depth = depth;
  p.per_depth = fused_dot3(normal, view_ray(f, x, y)) * per_distance;
  p.per_column = normal.x * (f.scale_x * per_distance);
  p.per_row = normal.y * (-f.scale_y * per_distance);
  p.normal = scale3(normal, per_cosine);
  p.square = 1 - per_cosine;
  return p;
}

// Distance of a neighbour from the plane; NaN for background. `step`: columns * per_column + rows * per_row to the neighbour.
static inline real distance_from(TangentPlane p, Frame f, real step, real depth) {
  const real pixel = multiply_add((real)(f.perspective), depth, (real)(f.parallel));
  return multiply_add(depth - p.depth, p.per_depth, pixel * step);
}

// 1 where a neighbour's normal equals the plane's; falls with the cosine to 0 at the tolerance and below 0 beyond it.
static inline real signed_agreement(TangentPlane p, real3 n) {
  return multiply_add(n.x, p.normal.x, multiply_add(n.y, p.normal.y, multiply_add(n.z, p.normal.z, (real)(p.square))));
}

// 1 where a neighbour's normal equals the plane's, 0 from the tolerance on.
static inline real agreement(TangentPlane p, real3 n) { return larger(signed_agreement(p, n), (real)(0)); }

// 1 on the same plane with the same normal; 0 from the tolerances on, and for background.
static inline real same_surface(TangentPlane p, Frame f, real step, real depth, real3 n) {
  return larger(1 - fabs(distance_from(p, f, step, depth)), (real)(0)) * agreement(p, n);
}

#endif
