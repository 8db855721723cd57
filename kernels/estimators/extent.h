// How thick occluders on one side of a slice are, judged by how far each extends on the screen: wide things are thick. Samples
// from the receiver outwards are divided into runs of one surface each.
#ifndef GLOAM_EXTENT_H
#define GLOAM_EXTENT_H

#include "shared/sampling/slice.h"

// A run ends where the depth changes by more than this multiple of the distance along the tangent, plus this share of the radius.
#define RUN_SLOPE ((scalar)2)
#define RUN_SLACK ((scalar)0.02f)

// As thick as wide, within these bounds in radii.
#define THICKNESS_OF_EXTENT ((scalar)1)
#define LEAST_THICKNESS ((scalar)0.05f)
#define MOST_THICKNESS ((scalar)2)

// The surface of the last sample. Lengths in units of the receiver's depth.
typedef struct {
  real depth, along;  // of the last sample: relative depth; distance along the tangent if it had the receiver's depth
  real start;         // of the run
  real extent;        // of the run so far, plus one step
} Run;

static inline Run run_from_receiver(void) {
  Run run;
  run.depth = run.along = run.start = run.extent = (real)(0);
  return run;
}

// Takes the next sample.
static inline void extend_run(Run* run, real depth, real along, real radius) {
  const real change = fabs(depth - run->depth), distance = along - run->along;
  const real most = multiply_add(distance, (real)(RUN_SLOPE), RUN_SLACK * radius);
  run->start = choose(change > most, along, run->start);
  run->extent = along - run->start + distance;
  run->depth = depth;
  run->along = along;
}

// Whether the last sample lies on another surface than the receiver.
static inline mask has_left_receiver(const Run* run) { return run->start > 0; }

static inline real thickness_of(real extent, real radius) {
  return smaller(larger(THICKNESS_OF_EXTENT * extent, LEAST_THICKNESS * radius), MOST_THICKNESS * radius);
}

#endif
