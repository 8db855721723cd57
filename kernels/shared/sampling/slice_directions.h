// The open directions of slices, for bent normals and cones. Include it after the type Side of one side of a slice and the function
//   real closed_towards(const Side* side, real along, real up)
// which says how far a direction is closed, 0 to 1, by its parts along the tangent and up from it.
#ifndef GLOAM_SLICE_DIRECTIONS_H
#define GLOAM_SLICE_DIRECTIONS_H

#include "estimators/bent_normal.h"
#include "estimators/glossy_lobe.h"
#include "shared/sampling/slice_steps.h"

#if WITH_OPEN_DIRECTIONS
#define BENT_STEPS 32
// Takes away the closed directions on one side, in steps of the angle to the line to the eye. `inverse_density`: of the slice
// (draw_slice). `sign`: of the side.
static inline void take_closed_side(OpenDirections* open, Surface surface, Slice slice, real inverse_density,
                                    const Side* side, scalar sign) {
  // pi^2 / BENT_STEPS in one literal: devices without double take each literal as a float, and round a product of two otherwise.
  const real wedge = inverse_density * ((scalar)0.308425137534042 / DIRECTIONS);
  // Half a step, pi / 64, then whole ones, pi / 32.
  scalar cosine = (scalar)0.9987954562, sine = (scalar)0.0490676743;
  for (int k = 0; k < BENT_STEPS; ++k) {
    // Elevation above the tangent.
    const real up = cosine * slice.cosine + sign * sine * slice.sine;
    const real along = sine * slice.cosine - sign * cosine * slice.sine;
    const real closed = choose(up > 0, closed_towards(side, along, up), (real)(0));
    const real3 v = surface.to_eye, t = slice.tangent;
    const scalar across = sign * sine;
    add_open(open, make3(v.x * cosine + t.x * across, v.y * cosine + t.y * across, v.z * cosine + t.z * across),
             closed * (-wedge * sine));
    const scalar next = cosine * (scalar)0.9951847267 - sine * (scalar)0.0980171403;
    sine = sine * (scalar)0.9951847267 + cosine * (scalar)0.0980171403;
    cosine = next;
  }
}
#endif

#endif
