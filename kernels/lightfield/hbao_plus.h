// Mean obscurance over directions x steps in the image.
#ifndef GLOAM_LIGHTFIELD_HBAO_PLUS_H
#define GLOAM_LIGHTFIELD_HBAO_PLUS_H

#include "estimators/obscurance.h"
#include "lightfield/spot.h"

static inline __attribute__((always_inline)) real obscurance_at(Params params, Surfaces planes, const Spot* s,
                                                                Reach reach, integer dx, integer dy, integer place,
                                                                int straight) {
  const real depth = gather(planes.depth + s->here, place);
#if GATHERS_ONLY
  return depth;
#endif
  real3 v, normal;
  look_at(planes, s, depth, dx, dy, place, straight, &v, &normal);
  return obscurance(v, normal, params.bias, reach.inverse_square);
}

static inline __attribute__((always_inline)) real sum_of_obscurance(Frame f, Params params, Surfaces planes,
                                                                    const Spot* s, Reach reach, Fan fan, int straight,
                                                                    int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy, place;
      step_at(fan, k, &dx, &dy);
      const mask counts = place_sample(f, s, within, &dx, &dy, &place);
      const real found = obscurance_at(params, planes, s, reach, dx, dy, place, straight);
      sum += counted(counts, found);
    }
    turn(&fan);
  }
  return sum;
}

static inline real open_share(Frame f, PROJECTIONS p, Params params, Surfaces planes, Spot s) {
  real sum;
  const Reach reach = reach_in_image(f, &s, params.radius, params.max_reach);
  const Fan fan = fan_of(reach, s.noise);
  LOOK_THROUGH(sum, f, p, s, reach, sum_of_obscurance(f, params, planes, &s, reach, fan, straight, within))
  return 1 - sum * (params.strength * 2 / (DIRECTIONS * STEPS));
}

#define OPEN_SHARE(f, p, params, planes, spot) open_share(f, p, params, planes, spot)

#endif
