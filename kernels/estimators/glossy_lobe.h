// How much of a glossy surface's lobe slices find closed (specular occlusion). A slice holds the line to the eye, so it also holds the
// microfacet that reflects any of its directions to the eye: at half the direction's angle from the eye. So GGX, which is a function
// of the microfacet's angle to the normal alone, is one of a single angle in a slice, and is sampled where it is large.
// Include it after the type Side and the function closed_towards (slice_directions.h).
#ifndef GLOAM_GLOSSY_LOBE_H
#define GLOAM_GLOSSY_LOBE_H

#include "shared/rays/ggx.h"
#include "shared/sampling/slice_steps.h"

#if WITH_LOBE
#define LOBE_SAMPLES 16

// Adds the slice's part of the lobe. `inverse_density`: of the slice (draw_slice).
//
// With m the length of the normal's projection into the slice, g its angle from the eye, and x the microfacet's angle from that
// projection, the normal has the cosine m cos(x) to the microfacet, and the direction is at t = 2 (x + g) from the eye. With
// w^2 = 1 - m^2 (1 - alpha^2) and tan(x) = w tan(p), GGX is drawn nearly evenly over p:
//   D dt = 2 alpha^2 / (pi w^3) (cos^2(p) + w^2 sin^2(p)) dp
static inline void take_lobe(OpenDirections* open, Surface surface, Slice slice, real inverse_density,
                             const Side* right, const Side* left) {
  const real alpha = open->alpha, square = alpha * alpha;
  const real facing = larger(surface.facing, (real)(1e-3f));
  const real hidden_to_eye = (scalar)0.5 * (sqrt(1 + square * (1 / (facing * facing) - 1)) - 1);
  const real m = smaller(surface.facing / slice.cosine, (real)(1));
  const real w_square = larger(1 - m * m, (real)(0)) * (1 - square) + square, w = sqrt(w_square);
  // Over the slice's share of half a turn, pi / DIRECTIONS, and p's steps, pi / LOBE_SAMPLES; the BRDF's 1 / (4 facing).
  const real wedge = inverse_density * ((scalar)(1.5707963267948966 / LOBE_SAMPLES) / DIRECTIONS);
  const real scale = wedge * square / (w_square * w * facing);
  // Half a step, pi / 32, from -pi / 2, then whole ones, pi / 16.
  scalar cosine = (scalar)0.0980171403, sine = (scalar)-0.9951847267;
  for (int k = 0; k < LOBE_SAMPLES; ++k) {
    const real tangent = w * (sine / cosine), cosine_x = (scalar)1 / sqrt(1 + tangent * tangent),
               sine_x = tangent * cosine_x;
    const real half_cosine = cosine_x * slice.cosine - sine_x * slice.sine;  // of half the direction's angle
    const real half_sine = sine_x * slice.cosine + cosine_x * slice.sine;
    const real to_eye = half_cosine * half_cosine - half_sine * half_sine, aside = 2 * half_sine * half_cosine;
    const real up = to_eye * slice.cosine + aside * slice.sine, along = aside * slice.cosine - to_eye * slice.sine;
    // Nearer to the tangent, the cosine of a horizon is 1 to float's rounding.
    const mask counts = (half_cosine > 0) & (up > (scalar)1e-3f);
    const real towards_normal = m * choose(counts, up, (real)(1)), square_of_light = towards_normal * towards_normal;
    const real hidden = (scalar)0.5 * (sqrt(1 + square * larger(1 / square_of_light - 1, (real)(0))) - 1);
    const real share = (cosine * cosine + w_square * (sine * sine)) * fabs(aside) / (1 + hidden_to_eye + hidden);
    const real weight = choose(counts, share * scale, (real)(0));
    const real height = choose(counts, up, (real)(1));
    const real closed = choose(half_sine > 0, closed_towards(right, choose(half_sine > 0, along, (real)(0)), height),
                               closed_towards(left, choose(half_sine > 0, (real)(0), -along), height));
    open->lobe += weight;
    open->lobe_closed += weight * closed;
    const scalar next = cosine * (scalar)0.9807852804 - sine * (scalar)0.1950903220;
    sine = sine * (scalar)0.9807852804 + cosine * (scalar)0.1950903220;
    cosine = next;
  }
}
#endif

#endif
