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

// A stack is one buffer with its layers one after another: this is one of them, a plane like any other. How many there
// are is a constant of the program (plan.h).
static inline global const float* layer_of(global const float* stack, Frame f, int layer) {
  return stack + (size_t)layer * (2 * FRAME_GUARD + (size_t)f.pitch * f.height);
}

static inline global float* layer_of_out(global float* stack, Frame f, int layer) {
  return stack + (size_t)layer * (2 * FRAME_GUARD + (size_t)f.pitch * f.height);
}

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

// Values of a plane dx pixels to the right of and dy pixels below each lane's own pixel; `here` is the first lane's index.
static inline real gather_near(PLANE plane, Frame f, int here, integer dx, integer dy) {
  return gather(plane + here, dy * f.pitch + (dx + IOTA));
}

// The same for |dy| and pitch below SHORT_PITCH: on AVX-512 a multiplication of 16 bits takes half the time of one of 32.
#define SHORT_PITCH 32768
static inline real gather_near_short(PLANE plane, Frame f, int here, integer dx, integer dy) {
#if LANES == 16 && defined(__AVX512BW__)
  typedef short Pairs __attribute__((vector_size(64)));
  // Products of the lower and of the upper half of each lane, added; the upper half of the pitch is 0.
  const integer rows =
      as_int16(__builtin_ia32_pmaddwd512(__builtin_astype(dy, Pairs), __builtin_astype((integer)(f.pitch), Pairs)));
  return gather(plane + here, rows + (dx + IOTA));
#else
  return gather_near(plane, f, here, dx, dy);
#endif
}

#endif
