// Points on a disk around a pixel's point, at right angles to the line to the eye, as the screen shows them at the pixel's depth:
// a Fibonacci spiral, evenly spread over the area (Vogel 1979). Turned and shifted by the pixel's noise.
// -D SAMPLES
#ifndef GLOAM_DISK_H
#define GLOAM_DISK_H

#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/slice.h"

typedef struct {
  real radius;                        // units of the pixel's depth
  real right_x, right_y, up_x, up_y;  // from centre to rim in two orthogonal directions of space, pixels
  real shift;                         // shift of the distances, 0 to 1
  scalar cosine, sine;                // of the next point
} Disk;

// As large as the reach on both axes allows. Its axes are those of the image, turned about the line to the eye (slice.h),
// then by the pixel's noise.
static inline Disk disk_of(Frame f, Anchor a, Surface s, Reach reach, Noise noise) {
  real cosine, sine;
  cosine_sine_of_turns(noise.turn, &cosine, &sine);
  const real inverse_level = quotient((real)(1), s.level);
  const real sheared = a.ray_x * a.ray_y * inverse_level, long_y = s.length * inverse_level;
  const real pixels_x = smaller(reach.pixels_x, reach.pixels_y * (f.scale_y / f.scale_x));
  const real pixels_y = pixels_x * (f.scale_x / f.scale_y);
  Disk d;
  d.radius = pixels_x * a.across_x;
  d.right_x = cosine * s.level * pixels_x;
  d.right_y = -(cosine * sheared + sine * long_y) * pixels_y;
  d.up_x = -sine * s.level * pixels_x;
  d.up_y = -(cosine * long_y - sine * sheared) * pixels_y;
  d.shift = noise.shift;
  d.cosine = 1;
  d.sine = 0;
  return d;
}

// Offset of point k in pixels, its distance in radii and the square of that; call with k = 0, 1, ... in order.
static inline void next_offset(Disk* d, int k, integer* dx, integer* dy, real* distance, real* square) {
  *square = (d->shift + k) * ((scalar)1 / SAMPLES);
  *distance = rough_square_root(*square);
  *dx = nearest(*distance * (d->cosine * d->right_x + d->sine * d->up_x));
  *dy = nearest(*distance * (d->cosine * d->right_y + d->sine * d->up_y));
  turn_golden(&d->cosine, &d->sine);
}

#endif
