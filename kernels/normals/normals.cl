// Normals from depth: cross product of the differences to the nearer neighbour on each axis, so that a depth edge on
// one side does not tilt them.
//
// in : depth   view-space z, scene units, +inf = background
// out: normal  unit, view space, towards the camera; zero on background
#include "shared/camera.h"
#include "shared/math.h"

// The smaller of two relative depths by size; a neighbour that is not there (or background) counts as infinitely far.
static inline mask nearer(real a, real b) { return fabs(a) < fabs(b); }

// Difference along one axis per pixel of that axis: to the neighbour ahead, or from the one behind; straight across
// where neither is there.
static inline real3 along(Frame f, Anchor p, real ahead, real behind, real dx, real dy) {
  const mask forward = nearer(ahead, behind);
  const real e = choose(forward, ahead, behind), sign = choose(forward, (real)(1), (real)(-1));
  const mask lone = e >= FARTHEST;
  const real3 v = towards(f, p, p.x + dx * sign, p.y + dy * sign, choose(lone, (real)(0), e));
  return scale3(v, sign);
}

kernel void normals(Frame frame, PLANE depth, PLANE_OUT normal_x, PLANE_OUT normal_y, PLANE_OUT normal_z) {
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here);
  const Anchor p = anchor_at(frame, to_real(x), (real)(y), z);

  const real none = FARTHEST;
  const real right = choose(to_mask(x + 1 < frame.width), relative_depth(p, z, load(depth, here + 1)), none);
  const real left = choose(to_mask(x > 0), relative_depth(p, z, load(depth, here - 1)), none);
  // Rows are the same for all lanes; the clamped row is not used.
  const int above_row = max(y - 1, 0), below_row = min(y + 1, frame.height - 1);
  const real above = y > 0 ? relative_depth(p, z, load(depth, index_of(frame, x0, above_row))) : none;
  const real below = y + 1 < frame.height ? relative_depth(p, z, load(depth, index_of(frame, x0, below_row))) : none;

  const real3 across = along(frame, p, right, left, (real)(1), (real)(0));
  const real3 up = along(frame, p, above, below, (real)(0), (real)(-1));
  // Scaled by the pixel's own extent, so that the product neither over- nor underflows.
  const real3 n = normalise3(cross3(scale3(across, 1 / p.across_x), scale3(up, 1 / p.across_y)));
  const mask away = dot3(n, view_ray(frame, p.x, p.y)) > 0;
  const real sign = choose(p.background, (real)(0), choose(away, (real)(-1), (real)(1)));
  store(n.x * sign, normal_x, here);
  store(n.y * sign, normal_y, here);
  store(n.z * sign, normal_z, here);
}
