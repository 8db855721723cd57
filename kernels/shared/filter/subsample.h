// Every SCALE-th pixel of depth and normal, unaveraged: what is computed from it is exact.
// -D SCALE
#ifndef GLOAM_SUBSAMPLE_H
#define GLOAM_SUBSAMPLE_H

#include "shared/lanes/load.h"

// `frame`: the reduced one; `other`: the finer one. Pixel (x, y) is pixel (x, y) * SCALE of the finer.
static inline void subsample_surface(Frame frame, Frame other, PLANE depth, PLANE normal_x, PLANE normal_y,
                                     PLANE normal_z, PLANE_OUT low_depth, PLANE_OUT low_normal_x,
                                     PLANE_OUT low_normal_y, PLANE_OUT low_normal_z) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  const integer step = IOTA * (integer)(SCALE);
  store(gather(depth + from, step), low_depth, to);
  store(gather(normal_x + from, step), low_normal_x, to);
  store(gather(normal_y + from, step), low_normal_y, to);
  store(gather(normal_z + from, step), low_normal_z, to);
}

// As subsample_surface, for a plane of three components.
static inline void subsample_vector(Frame frame, Frame other, PLANE x, PLANE y, PLANE z, PLANE_OUT low_x,
                                    PLANE_OUT low_y, PLANE_OUT low_z) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  const integer step = IOTA * (integer)(SCALE);
  store(gather(x + from, step), low_x, to);
  store(gather(y + from, step), low_y, to);
  store(gather(z + from, step), low_z, to);
}

#endif
