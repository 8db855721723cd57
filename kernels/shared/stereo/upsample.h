// Joint bilateral upsampling (upsample.h) for two views that agree (Shi, Billeter, Eisemann 2022) and still agree afterwards.
//
// A point is (S + S*) / (W + W*). W: sum of the weights of the four reduced pixels around it in this view, S: sum of weights
// times values; W* and S*: the same in the other view, around where it shows the point. Weights are bilinear, times those for
// distance from the point's tangent plane and for angle between normals (upsample.h). No weight depends on which view is
// computed: both views give a point the same mixture.
//
// Surfaces as thin as a pixel are often missing from all eight. Where W + W* is below FEW, the 16 reduced pixels around the point
// in each view count as well, even those of other surfaces, the more the closer they are. The transition is gradual: a choice
// between pixels would differ from view to view.
#ifndef GLOAM_STEREO_UPSAMPLE_H
#define GLOAM_STEREO_UPSAMPLE_H

#include "shared/filter/upsample.h"
#include "shared/stereo/fetch.h"

#define FEW ((scalar)0.01f)
// Largest weight of the 16 pixels, relative to the four.
#define FARTHER ((scalar)0.03f)
// Largest weight of a pixel of another surface, relative to one of the same.
#define ANOTHER_SURFACE ((scalar)1e-3f)

typedef struct {
  real sum, total;  // of weights times values, and of weights
} Mixture;

// Where the other view shows a row of pixels, in its reduced pixels. The image ends at the border of the whole image, which lies
// beyond the last reduced pixel.
static inline Projection project_row_into_reduced(Frame frame, Neighbour reduced, real depth) {
  reduced.frame.width += 1;
  reduced.frame.height += 1;
  return project_row(frame, reduced, depth);
}

static inline void mix_between(Mixture* m, const Between* b, Projection there, Frame other,
                               global const float* other_source) {
  if (!ANY(there.is_seen)) return;
  m->sum += choose(there.is_seen, weighted_between(b, other, WITHIN_A_LOAD, other_source), (real)(0));
  m->total += choose(there.is_seen, b->share, (real)(0));
}

// Weight of the 16 pixels: 0 where the four are enough.
static inline real share_of_farther(Mixture m) { return FARTHER * larger(1 - m.total * (1 / FEW), (real)(0)); }

// Positive and smooth for every surface, near or far. `step`: as for distance_from.
static inline real likeness(TangentPlane p, Frame f, real step, real depth, real3 n) {
  const real distance = smaller(fabs(distance_from(p, f, step, depth)), (real)(1e4f));  // the weight stays above 0
  const real turned = larger(1 - signed_agreement(p, n), (real)(0));
  const real same = larger(1 - distance, (real)(0)) * larger(1 - turned, (real)(0));
  const real off = (1 + distance * distance) * (1 + turned);
  return choose(is_background(depth), (real)(0), same + ANOTHER_SURFACE / (off * off));
}

// Adds the 16 pixels around a position in a reduced frame, by how near they are, times `counts`. `plane`: in this frame's pixels;
// `pixels`: the one at or left above; `right`, `below`: from it to the position; `how`: arrangement of the pixels, a constant.
static inline __attribute__((always_inline)) void mix_around(Mixture* m, Frame f, TangentPlane plane,
                                                             const PixelRow* pixels, real right, real below,
                                                             real counts, SurfacePlanes planes,
                                                             global const float* source, int how) {
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      const real dx = (scalar)i - right, dy = (scalar)j - below;
      const real near = (1 - (scalar)0.5 * fabs(dx)) * (1 - (scalar)0.5 * fabs(dy));
      const real depth = value_at(f, planes.depth, pixels, i, j, how);
      const real3 n =
          make3(value_at(f, planes.normal_x, pixels, i, j, how), value_at(f, planes.normal_y, pixels, i, j, how),
                value_at(f, planes.normal_z, pixels, i, j, how));
      const real weight = near * counts * likeness(plane, f, dx * plane.per_column + dy * plane.per_row, depth, n);
      const mask is_inside = to_mask((to_natural(pixels->column + i) < (natural)((uint)f.width)) &
                                     (to_natural(pixels->row + j) < (natural)((uint)f.height)));
      const real counted = choose(is_inside, weight, (real)(0));
      m->sum = multiply_add(counted, value_at(f, source, pixels, i, j, how), m->sum);
      m->total += counted;
    }
  }
}

// As mix_around, for this view, whose reduced pixels lie on its own.
static inline void mix_around_own(Mixture* m, Site s, Frame reduced, real counts, SurfacePlanes planes,
                                  global const float* source) {
  PixelRow pixels;
  pixels.column = (FIRST_X + IOTA) / SCALE;
  pixels.row = (integer)(ROW_Y / SCALE);
  pixels.first_column = FIRST_X / SCALE;
  pixels.y = ROW_Y / SCALE;
  pixels.lane = pixels.column - pixels.first_column;
  TangentPlane plane = s.plane;
  plane.per_column *= (scalar)SCALE;
  plane.per_row *= (scalar)SCALE;
  mix_around(m, reduced, plane, &pixels, to_real(s.right) * (scalar)(1.0f / SCALE),
             (real)(s.below * (scalar)(1.0f / SCALE)), counts, planes, source, WITHIN_A_LOAD);
}

static inline void mix_around_other(Mixture* m, const Between* b, Projection there, Frame other, real counts,
                                    SurfacePlanes planes, global const float* source) {
  if (!ANY(there.is_seen)) return;
  const real counted = choose(there.is_seen, counts, (real)(0));
  if (b->how == WITHIN_A_LOAD)
    mix_around(m, other, b->plane, &b->pixels, b->right, b->below, counted, planes, source, WITHIN_A_LOAD);
  else
    mix_around(m, other, b->plane, &b->pixels, b->right, b->below, counted, planes, source, ANYWHERE);
}

#endif
