// A spiral on the screen, from one pixel away to the radius: sample k of n lies at (k + shift) / n of the way, and the angle
// from sample to sample is the same (McGuire, Mara, Luebke 2012). The whole spiral makes TURNS turns, a number coprime to SAMPLES,
// so that no two samples lie in the same direction. Turned and shifted by the pixel's noise.
// -D SAMPLES, TURNS
#ifndef GLOAM_SPIRAL_H
#define GLOAM_SPIRAL_H

#include "shared/sampling/ambient_occlusion.h"

// The sample at hand.
typedef struct {
  real cosine, sine;            // direction
  real distance_x, distance_y;  // pixels along each axis
  real turn_cosine, turn_sine;  // from one sample to the next
  real stride_x, stride_y;
} Spiral;

static inline Spiral spiral_of(Reach reach, Noise noise) {
  Spiral s;
  cosine_sine_of_turns(noise.turn, &s.cosine, &s.sine);
  cosine_sine_of_turns((real)((scalar)TURNS / SAMPLES), &s.turn_cosine, &s.turn_sine);
  s.stride_x = larger(reach.pixels_x - 1, (real)(0)) * ((scalar)1 / SAMPLES);
  s.stride_y = larger(reach.pixels_y - 1, (real)(0)) * ((scalar)1 / SAMPLES);
  s.distance_x = 1 + noise.shift * s.stride_x;
  s.distance_y = 1 + noise.shift * s.stride_y;
  return s;
}

// Advances by one sample. Rounding adds up to less than a tenth of a pixel over 2048 samples with a reach of 500 pixels.
static inline void next_sample(Spiral* s) {
  const real next = s->cosine * s->turn_cosine - s->sine * s->turn_sine;
  s->sine = s->sine * s->turn_cosine + s->cosine * s->turn_sine;
  s->cosine = next;
  s->distance_x += s->stride_x;
  s->distance_y += s->stride_y;
}

// The sample's offset in pixels.
static inline void sample_at(Spiral s, integer* dx, integer* dy) {
  *dx = nearest(s.cosine * s.distance_x);
  *dy = nearest(s.sine * s.distance_y);
}

#endif
