// Separable cross-bilateral filter, one axis (Petschnigg et al. 2004, Eisemann and Durand 2004; separable in spite of
// the range weights as in Pham and van Vliet 2005). A tap counts by its distance on the screen (biweight window), by
// its distance from the pixel's tangent plane and by the angle between the normals; each weight ends at 0.
//
// in : source  to be filtered      depth  view-space z, scene units, +inf = background      normal  unit, view space
// out: result  filtered; 1 on background
// -D HALF_WIDTH, VERTICAL
#include "bilateral/params.h"
#include "shared/surface.h"

kernel void bilateral(Frame frame, BilateralParams params, PLANE source, PLANE depth, PLANE normal_x, PLANE normal_y,
                      PLANE normal_z, PLANE_OUT result) {
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here), own = load(source, here);
  const real3 n = load3(normal_x, normal_y, normal_z, here);
  const Anchor p = anchor_at(frame, to_real(x), (real)(y), z);
  const Tolerance tolerance = tolerance_of(p, params.depth_tolerance * params.radius, params.normal_tolerance);

#if VERTICAL
  const int from = -min(HALF_WIDTH, y), to = min(HALF_WIDTH, frame.height - 1 - y);
#else
  const int from = -HALF_WIDTH, to = HALF_WIDTH;
#endif
  real sum = own, weights = 1;
  for (int k = from; k <= to; ++k) {
    const scalar t = (scalar)k / (HALF_WIDTH + 1), window = (1 - t * t) * (1 - t * t);
#if VERTICAL
    const int there = here + k * frame.pitch;
    const real3 v = towards(frame, p, p.x, p.y + k, relative_depth(p, z, load(depth, there)));
#else
    const int there = here + k;
    const real3 v = towards(frame, p, p.x + k, p.y, relative_depth(p, z, load(depth, there)));
#endif
    const real same = same_surface(tolerance, v, n, load3(normal_x, normal_y, normal_z, there));
    real weight = k == 0 ? (real)(0) : window * same;
#if !VERTICAL
    weight = choose(to_mask((x + k >= 0) & (x + k < frame.width)), weight, (real)(0));
#endif
    sum += weight * load(source, there);
    weights += weight;
  }
  store(choose(p.background, (real)(1), sum / weights), result, here);
}
