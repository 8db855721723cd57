// Reading and writing planes. Layout: FRAME_GUARD floats, rows of `pitch` floats, FRAME_GUARD floats.
#ifndef GLOAM_LOAD_H
#define GLOAM_LOAD_H

#include "shared/both/frame.h"
#include "shared/lanes/lanes.h"

#define PLANE global const float* restrict
#define PLANE_OUT global float* restrict
#define TABLE constant float*

// The row of pixels that this work-item computes.
#define FIRST_X ((int)get_global_id(0) * LANES)
#define ROW_Y ((int)get_global_id(1))

// Index of pixel (x, y). Up to FRAME_GUARD pixels left and right of a row may be loaded: they belong to other rows or to the
// guard, and the caller ignores them by their x.
static inline int index_of(Frame f, int x, int y) { return FRAME_GUARD + y * f.pitch + x; }

// One layer of a stack, a buffer with its layers one after another; it is used like any plane. The number of layers is a
// constant of the program (plan.h).
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

// On CPUs: says that the row at an index will be loaded. An index beyond the plane does no harm.
static inline void expect_load(global const float* plane, int i) {
#if LANES > 1 && defined(__x86_64__)
  __builtin_prefetch((const void*)(uintptr_t)(plane + i), 0, 2);
#endif
}

// As expect_load, for depth and normals.
static inline void expect_surface(global const float* depth, global const float* normal_x, global const float* normal_y,
                                  global const float* normal_z, int i) {
  expect_load(depth, i);
  expect_load(normal_x, i);
  expect_load(normal_y, i);
  expect_load(normal_z, i);
}

static inline real3 load3(PLANE x, PLANE y, PLANE z, int i) { return make3(load(x, i), load(y, i), load(z, i)); }

// Four lanes of a gather, by indices in pairs. Nothing is done to `v`, but the compiler must not see that it is part of a gather.
#if GATHERS_BY_LOADS && LANES == 16 && defined(__AVX512F__)
#define LOAD_FOUR(v, pair, next_pair)                                                                        \
  v = (float4)(plane[(int)pair], plane[pair >> 32], plane[(int)next_pair], plane[next_pair >> 32]); \
  __asm__("" : "+x"(v));
#endif

// Values of a plane at one index per lane. -D GATHERS_BY_LOADS: not by the processor's instruction for it.
static inline real gather(PLANE plane, integer i) {
#if LANES == 1
  return to_real(plane[i]);
#elif defined(LOAD_FOUR)
  const long8 pairs = as_long8(i);
  float4 a, b, c, d;
  LOAD_FOUR(a, pairs.s0, pairs.s1)
  LOAD_FOUR(b, pairs.s2, pairs.s3)
  LOAD_FOUR(c, pairs.s4, pairs.s5)
  LOAD_FOUR(d, pairs.s6, pairs.s7)
  return to_real((stored)(a, b, c, d));
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

// Whether each lane's index follows that of the lane before.
static inline int is_row_of(integer i) {
#if LANES == 1
  return 1;
#else
  return !ANY(to_mask(i != i.s0 + IOTA));
#endif
}

// As gather, in one load where `is_row`, which is_row_of tells.
static inline real gather_row(PLANE plane, integer i, int is_row) {
#if LANES == 1
  return gather(plane, i);
#else
  if (is_row) return load(plane, i.s0);
  return gather(plane, i);
#endif
}

static inline real3 gather3(PLANE x, PLANE y, PLANE z, integer i) {
  return make3(gather(x, i), gather(y, i), gather(z, i));
}

// Writes one value per lane to one index each. Lanes that share an index must have the same value.
static inline void scatter(real value, PLANE_OUT plane, integer i) {
  const stored v = to_stored(value);
#if LANES == 1
  plane[i] = v;
#else
  const float* values = (const float*)&v;
  const int* indices = (const int*)&i;
  for (int k = 0; k < LANES; ++k) plane[indices[k]] = values[k];
#endif
}

// The bits of two planes stored side by side, pixel by pixel. `pairs`: where the first pixel's pair lies.
static inline void gather_bit_pair(global const float* pairs, integer i, natural* first, natural* second) {
#if LANES == 1
  global const uint* p = (global const uint*)pairs;
  *first = p[2 * i];
  *second = p[2 * i + 1];
#else
  // One gather of 64 bits instead of two of 32.
  global const long* p = (global const long*)pairs;
#if LANES == 4
  const uint8 v = as_uint8((long4)(p[i.s0], p[i.s1], p[i.s2], p[i.s3]));
  *first = v.even;
  *second = v.odd;
#elif LANES == 8
  const uint16 v = as_uint16((long8)(p[i.s0], p[i.s1], p[i.s2], p[i.s3], p[i.s4], p[i.s5], p[i.s6], p[i.s7]));
  *first = v.even;
  *second = v.odd;
#else
  const uint16 v = as_uint16((long8)(p[i.s0], p[i.s1], p[i.s2], p[i.s3], p[i.s4], p[i.s5], p[i.s6], p[i.s7]));
  const uint16 w = as_uint16((long8)(p[i.s8], p[i.s9], p[i.sa], p[i.sb], p[i.sc], p[i.sd], p[i.se], p[i.sf]));
  *first = (natural)(v.even, w.even);
  *second = (natural)(v.odd, w.odd);
#endif
#endif
}

// As gather_bit_pair, of floats.
static inline void gather_pair(global const float* pairs, integer i, real* first, real* second) {
  natural a, b;
  gather_bit_pair(pairs, i, &a, &b);
  *first = to_real(as_stored(a));
  *second = to_real(as_stored(b));
}

// Writes the pairs of bits of the row of pixels from index `i` on.
static inline void store_bit_pair(natural first, natural second, global float* pairs, int i) {
#if LANES == 1
  global uint* p = (global uint*)pairs;
  p[2 * i] = first;
  p[2 * i + 1] = second;
#else
  natural low, high;
  low.even = first.lo;
  low.odd = second.lo;
  high.even = first.hi;
  high.odd = second.hi;
  JOIN(vstore, LANES)(as_stored(low), 0, pairs + 2 * i);
  JOIN(vstore, LANES)(as_stored(high), 0, pairs + 2 * i + LANES);
#endif
}

// As store_bit_pair, of floats.
static inline void store_pair(real first, real second, global float* pairs, int i) {
  store_bit_pair(as_natural(to_stored(first)), as_natural(to_stored(second)), pairs, i);
}

// As store_pair, for four planes side by side.
static inline void store_four(real first, real second, real third, real fourth, global float* fours, int i) {
#if LANES == 1
  store_pair(first, second, fours, 2 * i);
  store_pair(third, fourth, fours, 2 * i + 1);
#else
  // As pairs of pairs: (first, third) and (second, fourth).
  const stored a = to_stored(first), b = to_stored(second), c = to_stored(third), d = to_stored(fourth);
  stored low_ac, high_ac, low_bd, high_bd;
  low_ac.even = a.lo;
  low_ac.odd = c.lo;
  high_ac.even = a.hi;
  high_ac.odd = c.hi;
  low_bd.even = b.lo;
  low_bd.odd = d.lo;
  high_bd.even = b.hi;
  high_bd.odd = d.hi;
  store_pair(to_real(low_ac), to_real(low_bd), fours, 2 * i);
  store_pair(to_real(high_ac), to_real(high_bd), fours, 2 * i + LANES);
#endif
}

// Index, from the first lane's pixel, of the pixel dx to the right of and dy below each lane's own.
static inline integer index_near(Frame f, integer dx, integer dy) { return dy * f.pitch + (dx + IOTA); }

#if LANES == 16 && defined(__AVX512BW__)
#define HAS_SHORT_PRODUCT 1
#else
#define HAS_SHORT_PRODUCT 0
#endif

// Whether the pitch has more bits than a short product takes, where there is one.
static inline int is_wide(Frame f) { return HAS_SHORT_PRODUCT && f.pitch >= 32768; }

// As index_near, in a frame that is not wide: on AVX-512 a 16-bit product takes half as long as a 32-bit one.
static inline integer index_near_short(Frame f, integer dx, integer dy) {
#if HAS_SHORT_PRODUCT
  typedef short Pairs __attribute__((vector_size(64)));
  // Products of the lower and of the upper half of each lane, added; the upper half of the pitch is 0.
  const integer rows =
      as_int16(__builtin_ia32_pmaddwd512(__builtin_astype(dy, Pairs), __builtin_astype((integer)(f.pitch), Pairs)));
  return rows + (dx + IOTA);
#else
  return index_near(f, dx, dy);
#endif
}

#endif
