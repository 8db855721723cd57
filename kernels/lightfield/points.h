// The points of the balls, from a table of SAMPLES for each of RADII, as Algorithms 3 and 4 make them: a direction by its height on
// the axis and its angle about it, a distance by its share of the volume.
//
// The table holds x, y, the share of the axis and the share of the volume of points that pixels turn about the normal and shift along
// the distance. With OWN_POINTS it holds height, angle and share, each 0 to 1, and each pixel shifts all three around by numbers of
// its own (Cranley, Patterson 1976): one shift for all points of a radius, or with SINGLE_POINTS one for each point, which are then
// independent points, each pixel's anew.
// -D SAMPLES, HEMISPHERE, JITTER, OWN_POINTS, SINGLE_POINTS
#ifndef GLOAM_LIGHTFIELD_POINTS_H
#define GLOAM_LIGHTFIELD_POINTS_H

#include "shared/both/hash.h"
#include "shared/sampling/ball.h"

// A pixel's own random bits.
static inline natural choice_of(natural column, natural row, int seed) {
#if OWN_POINTS && JITTER
  return hash_of(column + hash_of(row + hash_of((natural)((uint)seed))));
#elif OWN_POINTS
  return hash_of((natural)((uint)seed));
#else
  return (natural)(0u);
#endif
}

#if OWN_POINTS
// A share of the table, 0 to 1, shifted around.
static inline real shifted(scalar share, natural bits) {
  const real sum = unit_random(bits) + share;
  return choose(sum >= 1, sum - 1, sum);
}
#endif

// Point `number` of the table. `choice`: choice_of.
static inline __attribute__((always_inline)) void set_point(TABLE points, int number, const Ball* ball, natural choice,
                                                            BallPoint* point) {
  TABLE entry = points + 4 * number;
#if OWN_POINTS
  const uint shift = SINGLE_POINTS ? number : number - number % SAMPLES;
  const natural height = hash_of(choice + shift * 0x9e3779b9u), angle = hash_of(height + 0x9e3779b9u);
  const real share = shifted(entry[0], height), axis = HEMISPHERE ? share : 2 * share - 1;
  const real sine = sqrt(larger(1 - axis * axis, (real)(0)));
  real x, y;
  cosine_sine_of_turns(shifted(entry[1], angle), &x, &y);
  point->x = sine * x;
  point->y = sine * y;
  point->axis = axis;
  point->distance = distance_at(ball, shifted(entry[3], hash_of(angle + 0x9e3779b9u)));
#else
  point->x = entry[0];
  point->y = entry[1];
  point->axis = entry[2];
  point->distance = distance_at(ball, entry[3]);
#endif
}

#endif
