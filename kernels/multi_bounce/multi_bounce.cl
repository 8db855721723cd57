// Ambient light with interreflection, from AO and the albedo of the same surface (Jimenez, Wu, Pesce, Jarabo 2016, section 6, whose
// cubic is fitted to scenes of one albedo each):
//   jimenez  max(A, ((a A + b) A + c) A)  with a, b and c linear in the albedo
//   own      A + rho (1 - A) sqrt(A) (FIRST - FURTHER rho)
// Both are A where the albedo rho is 0, 0 where A is, and 1 where A is; they rise with A.
//
// in : ao       1 = open .. 0 = closed; 1 on background
//      albedo   0 to 1
// out: bounces  1 = as from an open white sky; 1 on background
// -D JIMENEZ
#include "shared/lanes/load.h"
#include "shared/lanes/math.h"

// Fitted to traced light (README.md).
#define FIRST ((scalar)1.01)
#define FURTHER ((scalar)0.37)

// Clamped to 0 to 1; NaN becomes 0.
static inline real share(real v) { return smaller(larger(v, (real)(0)), (real)(1)); }

static inline real with_bounces(real ao, real albedo) {
#if JIMENEZ
  const real a = (scalar)2.0404 * albedo - (scalar)0.3324;
  const real b = (scalar)-4.7951 * albedo + (scalar)0.6417;
  const real c = (scalar)2.7552 * albedo + (scalar)0.6903;
  return smaller(larger(((a * ao + b) * ao + c) * ao, ao), (real)(1));
#else
  const real root = ao * inverse_sqrt(larger(ao, (real)(1e-12f)));
  return smaller(ao + albedo * (1 - ao) * root * (FIRST - FURTHER * albedo), (real)(1));
#endif
}

// in : ao, albedo
// out: bounces
kernel void multi_bounce(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real open = share(load(ao, here));
  store(with_bounces(open, share(load(albedo_r, here))), bounces_r, here);
  store(with_bounces(open, share(load(albedo_g, here))), bounces_g, here);
  store(with_bounces(open, share(load(albedo_b, here))), bounces_b, here);
}
