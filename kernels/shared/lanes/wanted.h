// The pixels of an image that a mask wants: one bit per pixel, 32 pixels to a word. Word k of a row lies where the row's pixel k
// would, in a plane's memory.
//
// A kernel that skips unwanted rows of pixels (Pass::can_skip) has SKIP_UNWANTED as its first line. With MASKED it reads `wanted`.
// -D MASKED; KEEP (skipped rows keep their values)
#ifndef GLOAM_WANTED_H
#define GLOAM_WANTED_H

#include "shared/lanes/load.h"

#define WANTED global const float* restrict
#define WANTED_OUT global float* restrict

static inline int words_of_row(Frame f) { return (f.width + 31) / 32; }

// The bits of a word whose pixels lie in the image.
static inline uint bits_in_frame(Frame f, int k) {
  const int left = f.width - 32 * k;
  return left >= 32 ? 0xffffffffu : (1u << left) - 1;
}

// Bit i: the mask of lane i. In one instruction where there is one. (`m ? constants : 0` takes an AMD EPYC 40 ns where no lane is set.)
static inline uint bit_of_each_lane(mask m) {
#if LANES == 1
  return m ? 1u : 0u;
#elif LANES == 16 && defined(__AVX512DQ__) && !defined(REAL_DOUBLE)
  return (ushort)__builtin_ia32_cvtd2mask512(m);
#elif LANES == 8 && defined(__AVX__) && !defined(REAL_DOUBLE)
  return (uint)__builtin_ia32_movmskps256(as_float8(m));
#elif LANES == 4 && defined(__SSE__) && !defined(REAL_DOUBLE)
  return (uint)__builtin_ia32_movmskps(as_float4(m));
#else
  const natural bits = bits_of(m) & ((natural)(1) << to_natural(IOTA));
#if LANES == 16
  const uint8 eight = bits.lo | bits.hi;
  const uint4 four = eight.lo | eight.hi;
#elif LANES == 8
  const uint4 four = bits.lo | bits.hi;
#else
  const uint4 four = bits;
#endif
  const uint2 two = four.lo | four.hi;
  return two.x | two.y;
#endif
}

// The wanted pixels of a work-item's columns in a row.
static inline mask wanted_in_row(WANTED wanted, Frame f, int y) {
  const uint word = ((global const uint*)wanted)[index_of(f, FIRST_X / 32, y)] >> (FIRST_X % 32);
#if LANES == 1
  return word & 1;
#else
  return to_mask(((integer)((int)word) & ((integer)(1) << IOTA)) != 0);
#endif
}

#if KEEP
#define OPEN_UNLESS_KEPT(STORE)
#else
#define OPEN_UNLESS_KEPT(STORE) STORE;
#endif

// WANTED_PIXELS(frame, y): the wanted pixels of a work-item's columns in row y.
// WANTED_ROWS(frame, first, end): bit i tells whether one of them is wanted in row first + i, before `end`; at most 32 rows.
#if MASKED
#define WANTED_PIXELS(frame, y) wanted_in_row(wanted, frame, y)
#define WANTED_ROWS(frame, first, end) rows_with_wanted(wanted, frame, first, end)

static inline uint rows_with_wanted(WANTED wanted, Frame f, int first, int end) {
  uint rows = 0;
  for (int y = first; y < end; ++y) rows |= ANY(wanted_in_row(wanted, f, y)) ? 1u << (y - first) : 0;
  return rows;
}
#else
#define WANTED_PIXELS(frame, y) EVERY_LANE
#define WANTED_ROWS(frame, first, end) 0xffffffffu
#endif

// Defines `is_wanted`. If no pixel of the row is wanted, the kernel returns after STORE, which writes the values of skipped
// pixels at index `here`.
#if MASKED
#define SKIP_UNWANTED(frame, STORE)                    \
  const mask is_wanted = WANTED_PIXELS(frame, ROW_Y);  \
  if (!ANY(is_wanted)) {                               \
    const int here = index_of(frame, FIRST_X, ROW_Y);  \
    OPEN_UNLESS_KEPT(STORE)                            \
    return;                                            \
  }
#else
#define SKIP_UNWANTED(frame, STORE) const mask is_wanted = EVERY_LANE;
#endif

#endif
