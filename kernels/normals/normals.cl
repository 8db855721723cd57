// Normals from depth: the plane through the pixel and the nearer neighbour on each axis, so that a depth edge on one side does
// not tilt it.
//
// in : depth   view-space z, scene units, +inf = background
// out: normal  unit, view space, towards the camera; zero on background
#include "shared/frame/camera.h"
#include "shared/lanes/math.h"

// A surface steeper than this is seen edge-on; squares stay far from overflow.
#define STEEPEST ((scalar)1e12f)

// Slope of the surface along one axis: relative depth gained per distance across, on the plane through the pixel and the neighbour
// that is nearer in depth. `ahead`, `behind`: depths of the neighbours, +inf where there is none; without either the slope is 0.
// `across`: from pixel to pixel at the pixel's depth.
static inline real slope(Frame f, Anchor p, real own, real ahead, real behind, real across) {
  const mask forward = fabs(relative_depth(p, own, ahead)) < fabs(relative_depth(p, own, behind));
  const real nearer = choose(forward, ahead, behind), sign = choose(forward, (real)(1), (real)(-1));
  const real depth = choose(is_background(nearer), own, nearer);
  // A neighbour at a times the depth lies a times as far across.
  const real spread = larger(f.perspective * depth * p.inverse_depth + f.parallel, (real)(1e-18f));
  const real steep = sign * relative_depth(p, own, depth) / (across * spread);
  return smaller(larger(steep, (real)(-STEEPEST)), (real)(STEEPEST));
}

// in : depth
// out: normal
kernel void normals(ARGUMENTS) {
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here);
  const Anchor p = anchor_at(frame, to_real(x), (real)(y), z);

  const real right = choose(to_mask(x + 1 < frame.width), load(depth, here + 1), REAL_INFINITY);
  const real left = choose(to_mask(x > 0), load(depth, here - 1), REAL_INFINITY);
  // Rows are the same for all lanes.
  const real above = y > 0 ? load(depth, here - frame.pitch) : REAL_INFINITY;
  const real below = y + 1 < frame.height ? load(depth, here + frame.pitch) : REAL_INFINITY;

  // From the pixel the neighbours lie along X + a r and Y + b r; X, Y: the axes, r: the ray from the eye. Below is their cross
  // product without the products that cancel, a b (r x r). It faces the eye, as n.r = -1.
  const real a = slope(frame, p, z, right, left, p.across_x);
  const real b = slope(frame, p, z, above, below, p.across_y);
  const real3 r = view_ray(frame, p.x, p.y);
  const real3 sum = make3(a, b, 1 + a * r.x + b * r.y);
  // Scaled: where the rays of neighbours are far apart, the squares would overflow.
  const real largest = larger(larger(fabs(a), fabs(b)), fabs(sum.z));
  const real3 n = normalise3(scale3(sum, choose(largest > (scalar)1e15f, 1 / largest, (real)(1))));
  const real sign = choose(p.background, (real)(0), (real)(1));
  store(n.x * sign, normal_x, here);
  store(n.y * sign, normal_y, here);
  store(n.z * sign, normal_z, here);
}
