// A list of the pixels that are left to be computed: lanes take any pixels, where a mask would need a pass over the whole
// image. The list lies in a plane's memory: the number of pixels first, and their indices from FRAME_GUARD on.
//
// Work-items append in any order, so the order differs from run to run; a kernel that computes each pixel independently gives
// the same image all the same.
#ifndef GLOAM_PIXEL_LIST_H
#define GLOAM_PIXEL_LIST_H

#include "shared/lanes/load.h"

#define PIXEL_LIST global const float* restrict
#define PIXEL_LIST_OUT global float* restrict

static inline void empty_list(PIXEL_LIST_OUT list) { ((global int*)list)[0] = 0; }

// Appends the pixels of the row from index `here` on for which a mask holds.
static inline void append_pixels(PIXEL_LIST_OUT list, int here, mask which) {
  if (!ANY(which)) return;
  global int* entries = (global int*)list;
#if LANES == 1
  entries[FRAME_GUARD + atomic_inc(entries)] = here;
#else
  const natural chosen = bits_of(which);
  const uint* is_chosen = (const uint*)&chosen;
  int pixels[LANES], count = 0;
  for (int i = 0; i < LANES; ++i) {
    pixels[count] = here + i;
    count += is_chosen[i] != 0;
  }
  const int first = FRAME_GUARD + atomic_add(entries, count);
  for (int i = 0; i < count; ++i) entries[first + i] = pixels[i];
#endif
}

// The pixels of this work-item, one per lane, and how many there are: 0 at the end of the list. Launched as for all pixels of
// the image. Lanes left over get the first lane's pixel.
static inline int pixels_of_item(PIXEL_LIST list, Frame f, integer* index) {
  global const int* entries = (global const int*)list;
#if LANES == 1
  // Along the rows, so that the work-items of a warp take pixels that follow one another.
  const int first = ROW_Y * f.pitch + FIRST_X, count = entries[0];
#else
  // Down the columns of work-items: devices start the image row by row, and the first rows would get all the work.
  const int first = FIRST_X * f.height + ROW_Y * LANES, count = entries[0];
#endif
  if (first >= count) return 0;
  entries += FRAME_GUARD + first;
#if LANES == 1
  *index = entries[0];
#else
  const integer left = IOTA < (integer)(count - first) ? (integer)(-1) : (integer)(0);
  const integer all = JOIN(vload, LANES)(0, entries);
  *index = left ? all : (integer)(entries[0]);
#endif
  return 1;
}

static inline integer column_of(Frame f, integer index) { return (index - FRAME_GUARD) % f.pitch; }
static inline integer row_of(Frame f, integer index) { return (index - FRAME_GUARD) / f.pitch; }

#endif
