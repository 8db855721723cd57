// Where a search of slices samples: DIRECTIONS slices a pixel, STEPS samples on each side of a slice.
// -D DIRECTIONS, STEPS
#ifndef GLOAM_SLICE_STEPS_H
#define GLOAM_SLICE_STEPS_H

#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/slice_angle.h"

// One slice of DIRECTIONS, drawn in proportion to its weight. `turn`: in directions. Sets the cosine and sine of its angle;
// returns the inverse of its density, in shares of half a turn over DIRECTIONS.
static inline real draw_slice(Anchor point, Surface surface, real turn, real* cosine, real* sine) {
  cosine_sine_of_turns(turn * (scalar)(0.5f / DIRECTIONS), cosine, sine);
  return turn_by_weight(point, surface, cosine, sine);
}

// Distance of sample k from the pixel, in reaches: denser towards the pixel.
static inline real distance_of_step(int k, Noise noise) {
  const real even = (k + noise.shift) * (scalar)(1.0f / STEPS);
  return even * ((scalar)0.4f + (scalar)0.6f * even);
}

// One sample on one side of a slice.
typedef struct {
  real along, above;  // if it had the pixel's depth (slice.h); units of the pixel's depth
  real least;         // height above the tangent above which an occluder counts
  integer place;      // index from Receiver::here
  mask in_frame;
} SliceSample;

// Where the surface that a sample shows lies: along the tangent and above it, and the square of its distance.
typedef struct {
  real along, above, square;
} SlicePoint;

// `e`: relative depth (camera.h). `slope`, `above_e`: slice.h, `slope` with the sign of the side. Not returned, as oclgrind runs
// no function in a loop that returns a struct and is always inlined.
static inline __attribute__((always_inline)) void point_in_slice(Frame frame, SliceSample sample, real slope,
                                                                 real above_e, real e, SlicePoint* p) {
  const real q = multiply_add((real)(frame.perspective), e, (real)(1));
  p->above = multiply_add(e, above_e, q * sample.above);
  p->along = multiply_add(-slope, p->above, q * sample.along);
  // Above 0, so that its root can be divided by.
  p->square = multiply_add(p->along, p->along, multiply_add(p->above, p->above, (real)(1e-30f)));
}

// Sample k on both sides.
static inline __attribute__((always_inline)) void samples_of_step(Frame frame, scalar bias, Receiver r, Slice slice,
                                                                  int within, int k, SliceSample* right,
                                                                  SliceSample* left) {
  MAY_FUSE
  const real t = distance_of_step(k, r.noise);
  integer dx = nearest(slice.screen_x * r.reach.pixels_x * t), dy = nearest(slice.screen_y * r.reach.pixels_y * t);
  // From the unclamped position: at the border `along` may shrink to rounding.
  right->least = left->least = bias * (to_real(dx) * slice.along_x + to_real(dy) * slice.along_y);
  integer other_dx = -dx, other_dy = -dy;
  right->in_frame = left->in_frame = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
  right->along = to_real(dx) * slice.along_x + to_real(dy) * slice.along_y;
  right->above = to_real(dx) * slice.above_x + to_real(dy) * slice.above_y;
  const integer offset = index_within(frame, within, dx - IOTA, dy);
  right->place = r.own + offset;
  left->along = right->along;
  left->above = -right->above;
  left->place = r.own - offset;
  if (within != SAMPLES_INSIDE) {
    left->in_frame = keep_in_frame(frame, r.x, r.y, within, &other_dx, &other_dy);
    left->along = -(to_real(other_dx) * slice.along_x + to_real(other_dy) * slice.along_y);
    left->above = to_real(other_dx) * slice.above_x + to_real(other_dy) * slice.above_y;
    left->place = r.own + index_within(frame, within, other_dx - IOTA, other_dy);
  }
}

#endif
