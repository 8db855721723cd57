// HBAO+: mean obscurance over directions x steps on the screen (Bavoil, Sainz 2008; NVIDIA 2016; written out in
// Vermeer, Scandolo, Eisemann 2021, Algorithm 3 with one layer). AO = 1 - 2 / samples * sum of W(|v|) max(0, n.v/|v| -
// bias).
//
// in : depth   view-space z, scene units, +inf = background
//      normal  unit, view space
// out: ao_raw  1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, POWER, JITTER, NO_FALLOFF
#include "estimators/obscurance.h"
#include "hbao_plus/params.h"
#include "shared/sample.h"

kernel void hbao_plus_estimate(Frame frame, HbaoPlusParams params, PLANE depth, PLANE normal_x, PLANE normal_y,
                               PLANE normal_z, PLANE_OUT ao_raw) {
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here);
  const real3 n = load3(normal_x, normal_y, normal_z, here);
  const Anchor point = anchor_at(frame, to_real(x), (real)(y), z);
  const Reach reach = reach_of(point, params.radius, params.max_pixels);

#if JITTER
  const natural h = pixel_hash(x, y, frame.seed);
  const real turn = unit_random(h) * (scalar)(1.0f / DIRECTIONS), shift = unit_random(hash(h + 1));
#else
  const real turn = 0, shift = (scalar)0.5;
#endif
  // From one pixel away to the radius.
  const real stride_x = max(reach.pixels_x - 1, (real)(0)) * (scalar)(1.0f / STEPS);
  const real stride_y = max(reach.pixels_y - 1, (real)(0)) * (scalar)(1.0f / STEPS);

  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
    real cosine, sine;
    cosine_sine_of_turns(turn + d * (scalar)(1.0f / DIRECTIONS), &cosine, &sine);
    for (int k = 0; k < STEPS; ++k) {
      const real sx = point.x + (scalar)0.5 + cosine * (1 + (shift + k) * stride_x);
      const real sy = point.y + (scalar)0.5 + sine * (1 + (shift + k) * stride_y);
      const integer ix = clamp(to_integer(sx), 0, frame.width - 1);
      const integer iy = clamp(to_integer(sy), 0, frame.height - 1);
      const real e = relative_depth(point, z, gather(depth, index_of_lanes(frame, ix, iy)));
      sum += obscurance(towards(frame, point, to_real(ix), to_real(iy), e), n, params.bias, reach.inverse_square);
    }
  }
  const real open = clamp(1 - sum * (params.strength * 2 / (DIRECTIONS * STEPS)), (real)(0), (real)(1));
  real ao = open;
  for (int k = 1; k < POWER; ++k) ao *= open;
  store(choose(point.background, (real)(1), ao), ao_raw, here);
}
