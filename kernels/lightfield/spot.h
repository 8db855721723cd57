// The pixels that a work-item computes, and their surroundings, for any projection.
#ifndef GLOAM_LIGHTFIELD_SPOT_H
#define GLOAM_LIGHTFIELD_SPOT_H

#include "estimators/ball.h"
#include "shared/both/projection.h"
#include "shared/lanes/pixel_list.h"

// The planes that describe surfaces.
typedef struct {
  global const float *depth, *position_x, *position_y, *position_z;
} Surfaces;

static inline Surfaces surfaces_of(global const float* depth, global const float* x, global const float* y,
                                   global const float* z) {
  Surfaces s;
  s.depth = depth;
  s.position_x = x;
  s.position_y = y;
  s.position_z = z;
  return s;
}

// The pixels that a work-item computes: a row of them, or some from a list.
typedef struct {
  integer x, y;
  int here;        // index that `places` are relative to
  integer places;  // indices of the pixels
  real depth;
  real3 normal, position;  // view space
  real3 stored_position;   // as in the plane `position`
  real3 stored_normal;     // normal along that plane's axes
  Anchor point;            // for the surroundings, in depths of the pixel
  // Growth of distances across and up relative to depth: 1 perspective, 0 orthographic, negative with slits
  real spread_x, spread_y;
  Noise noise;
} Spot;

// Steps to the next pixel and along the pixel's own ray, for projections where both change evenly over the image.
static inline void set_straight(Spot* s, Frame f, PROJECTIONS p) {
  const real wide = p->grow_x * s->depth + p->base_x, high = p->grow_y * s->depth + p->base_y;
  s->point.across_x = p->scale_x * wide * s->point.inverse_depth;
  s->point.across_y = p->scale_y * high * s->point.inverse_depth;
  s->point.ray_x = p->grow_x * (s->position.x - p->origin_x) / wide;
  s->point.ray_y = p->grow_y * s->position.y / high;
  s->spread_x = p->grow_x * s->depth / wide;
  s->spread_y = p->grow_y * s->depth / high;
}

// The same steps where they change unevenly: those at the point itself.
static inline void set_skewed(Spot* s, Frame f, PROJECTIONS p) {
  const real3 q = physical_of(p, s->position);
  // Towards the middle of a curved screen: on the other side there may be no screen.
  const real far = (scalar)(1.0f / 64) * s->depth, step = choose(q.x > 0, -far, far);
  real x, y, right, up, aside;
  mask unused;
  project_through_slits(p, q, &x, &y, &unused);
  project_through_slits(p, physical_of(p, make3(s->position.x + step, s->position.y, s->position.z)), &right, &aside,
                        &unused);
  project_through_slits(p, physical_of(p, make3(s->position.x, s->position.y + step, s->position.z)), &aside, &up,
                        &unused);
  s->point.across_x = (scalar)(1.0f / 64) / larger(fabs(right - x), (real)(1e-6f));
  s->point.across_y = (scalar)(1.0f / 64) / larger(fabs(up - y), (real)(1e-6f));
  const Slopes slopes = slopes_through(p, q);
  const real3 ahead = times3(p->from_physical, make3(slopes.across, slopes.up, (real)(1)));
  s->point.ray_x = -ahead.x / ahead.z;
  s->point.ray_y = -ahead.y / ahead.z;
  // Only for bounds: relates the distances to the module and to the observers.
  s->spread_x = -(p->observer_ahead - q.z) / q.z;
  s->spread_y = (real)(1);
}

static inline void finish_spot(Spot* s, Frame f, PROJECTIONS p) {
  s->position = view_of_position(p, s->stored_position);
  // For background and for depths that can only be errors, any point serves that can be shown.
  const mask background = is_background(s->depth) | !can_be_shown(p, s->depth, s->position);
  const scalar safe = safe_depth(p);
  s->depth = choose(background, (real)(safe), s->depth);
  s->position = choose3(background, make3((real)(0), (real)(0), (real)(-safe)), s->position);
  s->point.x = to_real(s->x);
  s->point.y = to_real(s->y);
  s->point.background = background;
  s->point.inverse_depth = (scalar)1 / s->depth;
  s->point.lateral = (real)(1);
  s->stored_normal = transposed_times3(p->to_view, s->normal);
  if (p->is_straight)
    set_straight(s, f, p);
  else
    set_skewed(s, f, p);
  s->noise = noise_at(s->x, s->y, f.seed);
}

static inline Spot spot_in_row(Frame f, PROJECTIONS p, Surfaces planes, PLANE normal_x, PLANE normal_y,
                               PLANE normal_z) {
  Spot s;
  s.x = FIRST_X + IOTA;
  s.y = (integer)(ROW_Y);
  s.here = index_of(f, FIRST_X, ROW_Y);
  s.places = (integer)(IOTA);
  s.depth = load(planes.depth, s.here);
  s.normal = load3(normal_x, normal_y, normal_z, s.here);
  s.stored_position = load3(planes.position_x, planes.position_y, planes.position_z, s.here);
  finish_spot(&s, f, p);
  return s;
}

static inline Spot spot_of_list(Frame f, PROJECTIONS p, Surfaces planes, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                                integer index) {
  Spot s;
  s.x = column_of(f, index);
  s.y = row_of(f, index);
  s.here = 0;
  s.places = index;
  s.depth = gather(planes.depth, index);
  s.normal = gather3(normal_x, normal_y, normal_z, index);
  s.stored_position = gather3(planes.position_x, planes.position_y, planes.position_z, index);
  finish_spot(&s, f, p);
  return s;
}

// Clamps an offset to the image and makes it an index from `here`. Returns which samples count (keep_in_frame, sample.h).
static inline __attribute__((always_inline)) mask place_sample(Frame f, const Spot* s, int within, integer* dx,
                                                               integer* dy, integer* place) {
  mask counts = EVERY_LANE;
  if (within != SAMPLES_INSIDE) {
    const integer kept_x = clamp(s->x + *dx, (integer)(0), (integer)(f.width - 1)) - s->x;
    const integer kept_y = clamp(s->y + *dy, (integer)(0), (integer)(f.height - 1)) - s->y;
#if OUTSIDE_OPEN
    counts = to_mask((kept_x == *dx) & (kept_y == *dy));
#endif
    *dx = kept_x;
    *dy = kept_y;
  }
  *place = index_within(f, within, *dx + (s->places - IOTA), *dy);
  return counts;
}

// RESULT = CALL, with constants `straight` and `within` that hold for all samples up to `widest`.
#define LOOK_THROUGH(RESULT, f, p, spot, widest, CALL)       \
  if (!(p)->is_straight) {                                   \
    const int straight = 0, within = SAMPLES_IN_WIDE_FRAME;  \
    RESULT = CALL;                                           \
  } else if (is_wide(f)) {                                   \
    const int straight = 1, within = SAMPLES_IN_WIDE_FRAME;  \
    RESULT = CALL;                                           \
  } else if (reaches_only_inside(f, (spot).point, widest)) { \
    const int straight = 1, within = SAMPLES_INSIDE;         \
    RESULT = CALL;                                           \
  } else {                                                   \
    const int straight = 1, within = SAMPLES_CLAMPED;        \
    RESULT = CALL;                                           \
  }

// Reach of a radius (scene units) in the image, in pixels along each axis, capped (reach_of, sample.h).
static inline Reach reach_in_image(Frame f, const Spot* s, scalar radius, scalar max_reach) {
  const real most = (real)(max_reach * (scalar)f.width), relative = radius * s->point.inverse_depth;
  Reach r;
  r.pixels_x = smaller(relative / s->point.across_x, most);
  r.pixels_y = smaller(relative / s->point.across_y, most);
  const real inverse = larger(quick_inverse(larger(relative, (real)(1e-18f))), (real)(1e-15f));
  r.inverse_square = inverse * inverse;
  return r;
}

// From the point to the surface seen at an offset, in depths, and the normal, both along the same axes; background is far away.
static inline __attribute__((always_inline)) void look_at(Surfaces planes, const Spot* s, real depth, integer dx,
                                                          integer dy, integer place, int straight, real3* v,
                                                          real3* normal) {
  if (straight) {
    const real e = relative_depth(s->point, s->depth, depth), x = to_real(dx), y = to_real(dy);
    const real ray_x = multiply_add(x * s->point.across_x, s->spread_x, s->point.ray_x);
    const real ray_y = multiply_add(y * s->point.across_y, -s->spread_y, s->point.ray_y);
    *v = make3(multiply_add(e, ray_x, x * s->point.across_x), multiply_add(e, ray_y, y * -s->point.across_y), -e);
    *normal = s->normal;
    return;
  }
  const real3 there =
      gather3(planes.position_x + s->here, planes.position_y + s->here, planes.position_z + s->here, place);
  *v = scale3(minus3(there, s->stored_position), s->point.inverse_depth);
  *v = choose3(is_background(depth), make3((real)(FARTHEST), (real)(0), (real)(0)), *v);
  *normal = s->stored_normal;
}

#endif
