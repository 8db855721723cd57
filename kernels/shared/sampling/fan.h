// Directions x steps on the screen: straight lines from the pixel out to the radius, evenly spread, steps evenly spaced
// (Bavoil, Sainz 2008). Turned and shifted by the pixel's noise.
// -D DIRECTIONS, STEPS
#ifndef GLOAM_FAN_H
#define GLOAM_FAN_H

#include "shared/sampling/ambient_occlusion.h"

typedef struct {
  real cosine, sine;            // of the direction at hand
  real turn_cosine, turn_sine;  // from one direction to the next
  real stride_x, stride_y;      // from step to step, pixels
  real shift;                   // shift of the steps, 0 to 1
} Fan;

static inline Fan fan_of(Reach reach, Noise noise) {
  Fan f;
  cosine_sine_of_turns(noise.turn * (scalar)(1.0f / DIRECTIONS), &f.cosine, &f.sine);
  cosine_sine_of_turns((real)((scalar)1 / DIRECTIONS), &f.turn_cosine, &f.turn_sine);
  f.stride_x = larger(reach.pixels_x - 1, (real)(0)) * (scalar)(1.0f / STEPS);
  f.stride_y = larger(reach.pixels_y - 1, (real)(0)) * (scalar)(1.0f / STEPS);
  f.shift = noise.shift;
  return f;
}

static inline void turn(Fan* f) {
  const real next = f->cosine * f->turn_cosine - f->sine * f->turn_sine;
  f->sine = f->sine * f->turn_cosine + f->cosine * f->turn_sine;
  f->cosine = next;
}

// Offset of step k in pixels: from one pixel away to the radius.
static inline void step_at(Fan f, int k, integer* dx, integer* dy) {
  *dx = nearest(f.cosine * (1 + (f.shift + k) * f.stride_x));
  *dy = nearest(f.sine * (1 + (f.shift + k) * f.stride_y));
}

#endif
