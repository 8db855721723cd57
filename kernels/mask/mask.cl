// From a mask to the pixels left to compute: passes of the plan itself (host/plan/mask.h), not of a technique. A work-item
// computes the word (shared/lanes/wanted.h) that begins with its row of pixels, if one does.
//
// mask_bits     in : source  above 0 where an effect is wanted; with CELL > 1 for cells of CELL x CELL pixels, whose frame is
//                            `other`
//                    asked   bits of the pixels that are asked for (WITH_ASKED)
//               out: wanted  bits; with WITH_REST of whole groups of 16 pixels if one of them is wanted, so that every row of lanes
//                            is of one kind
//                    rest    bits of the other pixels (WITH_REST)
// mask_reduced  `frame`: the reduced one; `other`: the whole image
//               in : whole   bits of the whole image
//               out: wanted  bits of every SCALE-th pixel
// mask_grown    in : wanted
//               out: grown   wanted, and REACH_X columns and REACH_Y rows around it; undefined beside the image
// -D CELL, WITH_ASKED, WITH_REST (mask_bits); SCALE (mask_reduced); REACH_X (at most 32), REACH_Y (mask_grown)
#include "shared/lanes/wanted.h"

static inline void store_word(uint word, WANTED_OUT wanted, Frame f, int k) {
  ((global uint*)wanted)[index_of(f, k, ROW_Y)] = word & bits_in_frame(f, k);
}

#define RETURN_UNLESS_A_WORD_BEGINS(frame) \
  const int k = FIRST_X / 32;              \
  if (FIRST_X % 32 != 0 || k >= words_of_row(frame)) return;

#ifdef CELL
#if CELL == 1
#define BITS_OF_WORD(word) \
  for (int i = 0; i < 32; i += LANES) word |= bit_of_each_lane(load(source, index_of(frame, 32 * k + i, ROW_Y)) > 0) << i;
#elif 32 % CELL == 0
// Whole cells lie in a word.
#define BITS_OF_WORD(word)                                                    \
  const int first = index_of(other, 32 * k / CELL, ROW_Y / CELL);             \
  _Pragma("unroll") for (int c = 0; c < 32 / CELL; ++c)                       \
    word |= source[first + c] > 0 ? (0xffffffffu >> (32 - CELL)) << (c * CELL) : 0;
#else
// Pixels beyond the image read its last one.
#define BITS_OF_WORD(word)                                                    \
  const int row = index_of(other, 0, ROW_Y / CELL);                           \
  for (int i = 0; i < 32; ++i)                                                \
    word |= source[row + min(32 * k + i, frame.width - 1) / CELL] > 0 ? 1u << i : 0;
#endif

#if WITH_ASKED
#define ASKED_WORD ((global const uint*)asked)[index_of(frame, k, ROW_Y)]
#else
#define ASKED_WORD 0xffffffffu
#endif
#if WITH_REST
#define STORE_REST(word) store_word(word, rest, frame, k)
#define WHOLE_ROWS(word) (((word)&0xffffu ? 0xffffu : 0u) | ((word)&0xffff0000u ? 0xffff0000u : 0u))
#else
#define WHOLE_ROWS(word) (word)
#define STORE_REST(word)
#endif

// in : source; asked
// out: wanted; rest
kernel void mask_bits(ARGUMENTS) {
  RETURN_UNLESS_A_WORD_BEGINS(frame)
  uint word = 0;
  BITS_OF_WORD(word)
  word = WHOLE_ROWS(word & bits_in_frame(frame, k));
  store_word(word & ASKED_WORD, wanted, frame, k);
  STORE_REST(~word & ASKED_WORD);
}
#endif

#ifdef SCALE
// in : whole
// out: wanted
kernel void mask_reduced(ARGUMENTS) {
  RETURN_UNLESS_A_WORD_BEGINS(frame)
  const int each = 32 / SCALE;
  uint word = 0;
  for (int part = 0; part < SCALE; ++part) {
    if (k * SCALE + part >= words_of_row(other)) break;
    const uint from = ((global const uint*)whole)[index_of(other, k * SCALE + part, ROW_Y * SCALE)];
    for (int i = 0; i < each; ++i) word |= ((from >> (i * SCALE)) & 1u) << (part * each + i);
  }
  store_word(word, wanted, frame, k);
}
#endif

#ifdef REACH_X
// Words of a row from the k-th on, one per lane; 0 beside the row.
static inline natural words_at(WANTED row, Frame f, int k) {
  const integer number = k + IOTA;
#if LANES == 1
  return number >= 0 && number < words_of_row(f) ? ((global const uint*)row)[k] : 0u;
#else
  const natural words = JOIN(vload, LANES)(0, (global const uint*)row + k);
  return ((number >= 0) & (number < words_of_row(f))) ? words : (natural)(0);
#endif
}

// A work-item computes LANES words.
// in : wanted
// out: grown
kernel void mask_grown(ARGUMENTS) {
  if (FIRST_X >= words_of_row(frame)) return;
  natural before = 0, word = 0, after = 0;
  for (int dy = -REACH_Y; dy <= REACH_Y; ++dy) {
    WANTED row = wanted + index_of(frame, 0, clamp(ROW_Y + dy, 0, frame.height - 1));
    before |= words_at(row, frame, FIRST_X - 1);
    word |= words_at(row, frame, FIRST_X);
    after |= words_at(row, frame, FIRST_X + 1);
  }
  natural upwards = word, downwards = word;
  for (int done = 0; done < REACH_X;) {
    // Bits grown by `done` may be shifted by up to 2 done + 1 without leaving a gap; done + 1 is enough.
    const uint step = (uint)min(done + 1, REACH_X - done);
    upwards |= (upwards << step) | (before >> (32 - step));
    downwards |= (downwards >> step) | (after << (32 - step));
    before |= before << step;
    after |= after >> step;
    done += (int)step;
  }
  const natural found = upwards | downwards;
#if LANES == 1
  store_word(found, grown, frame, FIRST_X);
#else
  JOIN(vstore, LANES)(found, 0, (global uint*)grown + index_of(frame, FIRST_X, ROW_Y));
#endif
}
#endif
