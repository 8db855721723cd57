// From points in space to pixels and back, through a map that need not be a matrix: the two slits of a light-field display's
// module (Doronin, Kara, Barsi, Martini 2017, sections 3 and 5), or a perspective or orthographic camera. Kernels that use only
// this map run on every kind of view.
//
// View space has depths along -z, as everywhere. For two slits it lies on the observer line.
#ifndef GLOAM_PROJECTION_H
#define GLOAM_PROJECTION_H

#ifdef __OPENCL_C_VERSION__
#include "shared/frame/camera.h"
#include "shared/sampling/sample.h"
#define PROJECTION_SCALAR scalar
#define PROJECTION_NAME Projection
#endif

#endif

// The text below is included by the host once for float and once for double.
#ifdef PROJECTION_SCALAR

typedef struct {
  // 1: a pixel at depth d shows the point
  //   x = origin_x + (column + 0.5 - centre_x) * scale_x * (grow_x * d + base_x), y = (centre_y - row - 0.5) * scale_y * (...)
  // (grow, base): (1, 0) perspective, (0, 1) orthographic, (-1, distance of the module) across two slits.
  int is_straight;
  int is_curved;                                  // 1: the screen is curved
  PROJECTION_SCALAR rotation[9], translation[3];  // from the view space of the pixel at hand into this one, by rows
  PROJECTION_SCALAR to_view[9], shift[3];         // from the plane `position` into this view space
  PROJECTION_SCALAR origin_x, grow_x, base_x, grow_y, base_y, scale_x, scale_y, centre_x, centre_y;
  // Physical space (camera.h of the host), with its origin in the module.
  PROJECTION_SCALAR to_physical[9], from_physical[9], view_origin[3];
  PROJECTION_SCALAR observer_up, observer_ahead;
  PROJECTION_SCALAR screen_ahead;  // distance of a flat screen
  PROJECTION_SCALAR circle_x, circle_z,
      circle_constant;        // module from the centre of a curved screen; |.|^2 - radius^2
  PROJECTION_SCALAR turn[9];  // rows: right, up, ahead of the module
  PROJECTION_SCALAR fx, fy, cx, cy;
  PROJECTION_SCALAR share;  // weight of a key view where another one shows the point too
} PROJECTION_NAME;

#endif

#if defined(__OPENCL_C_VERSION__) && !defined(GLOAM_PROJECTION_FUNCTIONS)
#define GLOAM_PROJECTION_FUNCTIONS

typedef char projection_size_check[sizeof(Projection) == 8 + 74 * sizeof(scalar) ? 1 : -1];

// A kernel's argument after the frame: projection of the view, then those of the key views that it reads.
#define PROJECTIONS constant Projection*

static inline real3 times3(constant scalar* rows, real3 v) {
  return make3(rows[0] * v.x + rows[1] * v.y + rows[2] * v.z, rows[3] * v.x + rows[4] * v.y + rows[5] * v.z,
               rows[6] * v.x + rows[7] * v.y + rows[8] * v.z);
}

static inline real3 transposed_times3(constant scalar* rows, real3 v) {
  return make3(rows[0] * v.x + rows[3] * v.y + rows[6] * v.z, rows[1] * v.x + rows[4] * v.y + rows[7] * v.z,
               rows[2] * v.x + rows[5] * v.y + rows[8] * v.z);
}

static inline real3 plus3(real3 v, constant scalar* w) { return make3(v.x + w[0], v.y + w[1], v.z + w[2]); }
static inline real3 minus3(real3 a, real3 b) { return make3(a.x - b.x, a.y - b.y, a.z - b.z); }

// A value of the plane `position` in view space, and back.
static inline real3 view_of_position(PROJECTIONS p, real3 position) {
  return plus3(times3(p->to_view, position), p->shift);
}
static inline real3 position_of_view(PROJECTIONS p, real3 v) {
  return transposed_times3(p->to_view, make3(v.x - p->shift[0], v.y - p->shift[1], v.z - p->shift[2]));
}

// A point of the view space of the pixel at hand in this projection's, and back.
static inline real3 into_view(PROJECTIONS p, real3 v) { return plus3(times3(p->rotation, v), p->translation); }
static inline real3 back_from_view(PROJECTIONS p, real3 v) {
  return transposed_times3(p->rotation,
                           make3(v.x - p->translation[0], v.y - p->translation[1], v.z - p->translation[2]));
}

// Direction in physical space of the light that a point sends to the observers: sideways and up per step ahead.
typedef struct {
  real across, up;
} Slopes;

// `q`: a point between the module and the observers, physical, relative to the module.
static inline Slopes slopes_through(PROJECTIONS p, real3 q) {
  Slopes s;
  s.across = q.x / q.z;
  s.up = (p->observer_up - q.y) / (p->observer_ahead - q.z);
  return s;
}

// Distance ahead of the module at which light of this slope meets the screen; NaN where it does not.
static inline real reach_of_screen(PROJECTIONS p, real across) {
  if (!p->is_curved) return (real)(p->screen_ahead);
  const real a = 1 + across * across, b = across * p->circle_x + p->circle_z;
  const real root = sqrt(b * b - a * p->circle_constant);
  // Two forms of the same root: one of them would subtract almost equal numbers.
  return choose(b > 0, -p->circle_constant / (b + root), (root - b) / a);
}

// Column and row of a point, not rounded. `is_shown`: it has a pixel, inside the image or not.
static inline void project_through_slits(PROJECTIONS p, real3 q, real* x, real* y, mask* is_shown) {
  const Slopes s = slopes_through(p, q);
  const real ahead = reach_of_screen(p, s.across);
  const real3 spot = make3(s.across * ahead, p->observer_up - s.up * (p->observer_ahead - ahead), ahead);
  const real3 seen = times3(p->turn, spot);
  *is_shown = (q.z > 0) & (q.z < p->observer_ahead) & (ahead > 0) & (ahead < p->observer_ahead) & (seen.z > 0);
  *x = p->cx - (scalar)0.5 + p->fx * seen.x / seen.z;
  *y = p->cy - (scalar)0.5 - p->fy * seen.y / seen.z;
}

static inline real3 physical_of(PROJECTIONS p, real3 v) { return plus3(times3(p->to_physical, v), p->view_origin); }

// Where the image shows a point of its view space: column and row, not rounded; outside the image, those of its first pixel.
static inline void project_within(PROJECTIONS p, Frame f, real3 v, mask is_there, real* x, real* y, mask* is_inside) {
  mask is_shown;
  if (p->is_straight) {
    const real depth = -v.z, wide = p->grow_x * depth + p->base_x, high = p->grow_y * depth + p->base_y;
    is_shown = (depth > 0) & (wide > 0) & (high > 0);
    *x = (v.x - p->origin_x) / (wide * p->scale_x) + p->centre_x - (scalar)0.5;
    *y = p->centre_y - (scalar)0.5 - v.y / (high * p->scale_y);
  } else {
    project_through_slits(p, physical_of(p, v), x, y, &is_shown);
  }
  const scalar right = (scalar)f.width - (scalar)0.5, bottom = (scalar)f.height - (scalar)0.5;
  *is_inside = is_there & is_shown & (*x >= (scalar)-0.5) & (*x < right) & (*y >= (scalar)-0.5) & (*y < bottom);
  *x = choose(*is_inside, *x, (real)(0));
  *y = choose(*is_inside, *y, (real)(0));
}

// Whether a pixel can show this depth: it lies between the observers and the module, and so does its point.
static inline mask can_be_shown(PROJECTIONS p, real depth, real3 v) {
  if (p->is_straight) return (p->grow_x * depth + p->base_x > 0) & (p->grow_y * depth + p->base_y > 0);
  const real left = -v.z * p->to_physical[8];
  return (left > 0) & (left < p->observer_ahead);
}

// A depth that is always between the observers and the module.
static inline scalar safe_depth(PROJECTIONS p) {
  if (p->is_straight) return p->grow_x < 0 ? (scalar)0.5 * p->base_x : (scalar)1;
  return (scalar)0.5 * p->observer_ahead / p->to_physical[8];
}

// The point that a pixel shows at a depth, view space.
static inline real3 point_at(PROJECTIONS p, real x, real y, real depth) {
  if (p->is_straight) {
    const real across = (x + (scalar)0.5 - p->centre_x) * p->scale_x, up = (p->centre_y - y - (scalar)0.5) * p->scale_y;
    return make3(p->origin_x + across * (p->grow_x * depth + p->base_x), up * (p->grow_y * depth + p->base_y), -depth);
  }
  const real3 out = transposed_times3(
      p->turn, make3((x + (scalar)0.5 - p->cx) / p->fx, (p->cy - y - (scalar)0.5) / p->fy, (real)(1)));
  const real across = out.x / out.z, ahead = reach_of_screen(p, across);
  const real up = (p->observer_up - out.y / out.z * ahead) / (p->observer_ahead - ahead);
  // Measured from the observers' line, near which digits would be lost otherwise; the last row of to_physical has one element.
  const real left = depth * p->to_physical[8];
  return times3(p->from_physical, make3(across * (p->observer_ahead - left) - p->view_origin[0], -up * left, -left));
}

#endif
