// Joint bilateral upsampling (Kopf, Cohen, Lischinski, Uyttendaele 2007): of the four reduced pixels around a pixel, those
// that show the same surface are mixed by bilinear weights; where none does, the one nearest to the tangent plane is taken.
// `frame`: the finer one; `other`: the reduced one, whose pixel (x, y) is pixel (x, y) * SCALE of the finer.
// -D SCALE
//
//   const Site s = site_at(frame, other, distance, angle, depth, normal_x, normal_y, normal_z);
//   const Weights w = weights_of(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
//   ... quotient(weighted(w, s, source), w.total) ...
#ifndef GLOAM_UPSAMPLE_H
#define GLOAM_UPSAMPLE_H

#include "shared/frame/surface.h"

// Reduced pixels for a row of pixels: for each the one at or left of it (`i` = 0), or the next one to the right (1).
// `there`: index of the first pixel's.
#if LANES == 1
static inline real load_beside(PLANE plane, int there, int i) { return load(plane, there + i); }
#else
#ifdef REAL_DOUBLE
#define LANE_INDEX JOIN(convert_, N_LANES(ulong))
#else
#define LANE_INDEX JOIN(convert_, N_LANES(uint))
#endif
static inline real load_beside(PLANE plane, int there, int i) {
  return shuffle(load(plane, there), LANE_INDEX(IOTA / SCALE + i));
}
#endif

static inline real3 load3_beside(PLANE x, PLANE y, PLANE z, int there, int i) {
  return make3(load_beside(x, there, i), load_beside(y, there, i), load_beside(z, there, i));
}

// A row of pixels and the two rows of reduced pixels around it.
typedef struct {
  int here, there[2];  // indices of the first pixel of each row
  int rows;            // reduced rows with a weight: one where the row of pixels lies on a reduced row
  integer right;       // distance from the reduced column at or left of each pixel, in pixels
  scalar below;        // distance from the reduced row at or above, in pixels
  mask has_right;      // whether there is a reduced pixel to the right
  TangentPlane plane;
} Site;

// `distance`, `angle`: as for `tangent_plane_at`.
static inline Site site_at(Frame frame, Frame other, scalar distance, scalar angle, PLANE depth, PLANE normal_x,
                           PLANE normal_y, PLANE normal_z) {
  Site s;
  const int y = ROW_Y, row = y / SCALE;
  const integer x = FIRST_X + IOTA;
  s.here = index_of(frame, FIRST_X, y);
  s.rows = y % SCALE != 0 && row + 1 < other.height ? 2 : 1;
  for (int j = 0; j < 2; ++j) s.there[j] = index_of(other, FIRST_X / SCALE, min(row + j, other.height - 1));
  s.right = x % SCALE;
  s.below = (scalar)(y % SCALE);
  s.has_right = to_mask(x / SCALE + 1 < other.width);
  s.plane = tangent_plane_at(frame, to_real(x), (real)(y), load(depth, s.here),
                             load3(normal_x, normal_y, normal_z, s.here), distance, angle);
  return s;
}

// Bilinear weight of the reduced pixel `i` to the right of and `j` below the one at or left above; 0 outside the image.
static inline real bilinear(Site s, int i, int j) {
  const real right = to_real(s.right) * (scalar)(1.0f / SCALE);
  const scalar below = s.below * (scalar)(1.0f / SCALE);
  const real across = i == 0 ? 1 - right : choose(s.has_right, right, (real)(0));
  return across * (j == 0 ? 1 - below : below);
}

static inline real distance_to(Site s, Frame frame, int i, int j, real depth) {
  const real step = to_real(i * SCALE - s.right) * s.plane.per_column + (j * SCALE - s.below) * s.plane.per_row;
  return fabs(distance_from(s.plane, frame, step, depth));
}

// Weights of the four reduced pixels around a pixel: of[row][column].
typedef struct {
  real of[2][2];
  real total;  // 0 where all four are background
} Weights;

// Where none of the four shows the same surface, gives all weight to the one nearest to the tangent plane.
static inline void take_nearest(Weights* w, mask alone, Site s, Frame frame, PLANE low_depth) {
  real nearest = REAL_INFINITY, total = 0;
  for (int j = 0; j < s.rows; ++j) {
#pragma unroll
    for (int i = 0; i < 2; ++i) {
      const real distance = distance_to(s, frame, i, j, load_beside(low_depth, s.there[j], i));
      nearest = choose((bilinear(s, i, j) > 0) & (distance < nearest), distance, nearest);
    }
  }
  for (int j = 0; j < s.rows; ++j) {
#pragma unroll
    for (int i = 0; i < 2; ++i) {
      const real distance = distance_to(s, frame, i, j, load_beside(low_depth, s.there[j], i));
      const mask is_nearest = (bilinear(s, i, j) > 0) & (distance == nearest) & (total == 0);
      const real weight = choose(is_nearest, (real)(1), (real)(0));
      total += weight;
      w->of[j][i] = choose(alone, weight, w->of[j][i]);
    }
  }
  w->total = choose(alone, total, w->total);
}

// Weights of those of the four that show the same surface.
static inline Weights weights_of_same(Site s, Frame frame, PLANE low_depth, PLANE low_normal_x, PLANE low_normal_y,
                                      PLANE low_normal_z) {
  Weights w;
  w.total = 0;
#pragma unroll
  for (int j = 0; j < 2; ++j) {
    w.of[j][0] = w.of[j][1] = 0;
    if (j >= s.rows) continue;
#pragma unroll
    for (int i = 0; i < 2; ++i) {
      const real distance = distance_to(s, frame, i, j, load_beside(low_depth, s.there[j], i));
      const real3 n = load3_beside(low_normal_x, low_normal_y, low_normal_z, s.there[j], i);
      w.of[j][i] = bilinear(s, i, j) * larger(1 - distance, (real)(0)) * agreement(s.plane, n);
      w.total += w.of[j][i];
    }
  }
  return w;
}

static inline Weights weights_of(Site s, Frame frame, PLANE low_depth, PLANE low_normal_x, PLANE low_normal_y,
                                 PLANE low_normal_z) {
  Weights w = weights_of_same(s, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
  const mask alone = !is_background(s.plane.depth) & !(w.total > (scalar)1e-3f);
  if (ANY(alone)) take_nearest(&w, alone, s, frame, low_depth);
  return w;
}

// Sum of weights times values: divided by `total` it is the upsampled value.
static inline real weighted(Weights w, Site s, PLANE source) {
  real sum = 0;
#pragma unroll
  for (int j = 0; j < 2; ++j) {
    if (j >= s.rows) continue;
#pragma unroll
    for (int i = 0; i < 2; ++i) sum = multiply_add(w.of[j][i], load_beside(source, s.there[j], i), sum);
  }
  return sum;
}

#endif
