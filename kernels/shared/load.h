// Reading and writing planes. Layout: FRAME_GUARD floats, rows of `pitch` floats, FRAME_GUARD floats.
#ifndef GLOAM_LOAD_H
#define GLOAM_LOAD_H

#include "shared/frame.h"
#include "shared/lanes.h"

#define PLANE global const float* restrict
#define PLANE_OUT global float* restrict

// The row of pixels that this work-item computes.
#define FIRST_X ((int)get_global_id(0) * LANES)
#define ROW_Y ((int)get_global_id(1))

// Where pixel (x, y) lies. Up to FRAME_GUARD pixels left and right of a row may be loaded: they belong to other rows or
// to the guard, and the caller leaves them out by their x.
static inline int index_of(Frame f, int x, int y) { return FRAME_GUARD + y * f.pitch + x; }
static inline integer index_of_lanes(Frame f, integer x, integer y) { return FRAME_GUARD + y * f.pitch + x; }

#if LANES == 1
static inline real load(PLANE plane, int i) { return to_real(plane[i]); }
static inline void store(real value, PLANE_OUT plane, int i) { plane[i] = to_stored(value); }
#else
static inline real load(PLANE plane, int i) { return to_real(JOIN(vload, LANES)(0, plane + i)); }
static inline void store(real value, PLANE_OUT plane, int i) { JOIN(vstore, LANES)(to_stored(value), 0, plane + i); }
#endif

static inline real3 load3(PLANE x, PLANE y, PLANE z, int i) { return make3(load(x, i), load(y, i), load(z, i)); }

// Values of a plane at one index per lane.
static inline real gather(PLANE plane, integer i) {
#if LANES == 1
  return to_real(plane[i]);
#elif LANES == 4
  return to_real((stored)(plane[i.s0], plane[i.s1], plane[i.s2], plane[i.s3]));
#elif LANES == 8
  return to_real(
      (stored)(plane[i.s0], plane[i.s1], plane[i.s2], plane[i.s3], plane[i.s4], plane[i.s5], plane[i.s6], plane[i.s7]));
#else
  return to_real((stored)(plane[i.s0], plane[i.s1], plane[i.s2], plane[i.s3], plane[i.s4], plane[i.s5], plane[i.s6],
                          plane[i.s7], plane[i.s8], plane[i.s9], plane[i.sa], plane[i.sb], plane[i.sc], plane[i.sd],
                          plane[i.se], plane[i.sf]));
#endif
}

#endif
