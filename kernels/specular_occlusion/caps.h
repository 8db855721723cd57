// The solid angle that two caps of the sphere have in common (Tovchigrechko, Vakser 2001).
#ifndef GLOAM_SPECULAR_OCCLUSION_CAPS_H
#define GLOAM_SPECULAR_OCCLUSION_CAPS_H

#include "shared/lanes/math.h"

#define PI ((scalar)3.141592653589793)

// acos(c), c clamped to -1 to 1: absolute error below 3e-7. The polynomial of Abramowitz and Stegun 1964, 4.4.46.
static inline real arc_cosine(real c) {
  const real a = smaller(fabs(c), (real)(1));
  const real series =
      (scalar)1.5707963050 +
      a * ((scalar)-0.2145988016 +
           a * ((scalar)0.0889789874 +
                a * ((scalar)-0.0501743046 +
                     a * ((scalar)0.0308918810 +
                          a * ((scalar)-0.0170881256 + a * ((scalar)0.0066700901 + a * (scalar)-0.0012624911))))));
  const real arc = sqrt(1 - a) * series;
  return choose(c < 0, PI - arc, arc);
}

// A cap by the cosine and sine of its half angle, at most a right angle.
typedef struct {
  real cosine, sine;
} Cap;

static inline Cap cap_of(real cosine) {
  Cap c;
  c.cosine = cosine;
  c.sine = sqrt(larger(1 - cosine * cosine, (real)(0)));
  return c;
}

// Over 2 pi, so that a hemisphere has 1. `between`: the cosine of the angle between the caps' axes.
static inline real common_share(Cap a, Cap b, real between) {
  const real aside = sqrt(larger(1 - between * between, (real)(0)));
  const real cosines = a.cosine * b.cosine, sines = a.sine * b.sine;
  const mask one_holds_the_other = between >= cosines + sines, is_apart = between <= cosines - sines;
  const mask cross = !one_holds_the_other & !is_apart;
  // What caps that do not cross would divide by may be 0.
  const real per_sines = (scalar)1 / choose(cross, sines, (real)(1));
  const real per_a = (scalar)1 / choose(cross, aside * a.sine, (real)(1));
  const real per_b = (scalar)1 / choose(cross, aside * b.sine, (real)(1));
  const real lens = PI - arc_cosine((between - cosines) * per_sines) -
                    a.cosine * arc_cosine((b.cosine - between * a.cosine) * per_a) -
                    b.cosine * arc_cosine((a.cosine - between * b.cosine) * per_b);
  const real crossing = larger(lens * ((scalar)1 / PI), (real)(0));
  return choose(cross, crossing, choose(one_holds_the_other, 1 - larger(a.cosine, b.cosine), (real)(0)));
}

#endif
