// Share of the points in balls around a pixel's point that lie behind what the image shows (Algorithms 2 to 4).
#ifndef GLOAM_LIGHTFIELD_SSAO_H
#define GLOAM_LIGHTFIELD_SSAO_H

#include "lightfield/points.h"
#include "lightfield/spot.h"

typedef struct {
  Surface surface;
  real3 axis;
  Ball ball;
  natural choice;  // of the pixel's points (points.h)
} Directions;

// One ball in the image.
typedef struct {
  Axes axes;  // straight: pixels to the right and down, depths towards the eye; skewed: physical
  real3 from_module;
  Heights heights;
  Reach reach;
  real radius;  // in depths
  real per_range;
} Sphere;

// As large as the reach on both axes allows, and at most half the distance to the observers and to the module.
static inline Sphere sphere_at(Frame f, PROJECTIONS p, Params params, const Spot* s, const Directions* d,
                               scalar radius) {
  Sphere b;
  b.reach = reach_in_image(f, s, radius, params.max_reach);
  b.reach.pixels_x = smaller(b.reach.pixels_x, b.reach.pixels_y * (s->point.across_y / s->point.across_x));
  const real spread = larger(fabs(s->spread_x), fabs(s->spread_y));
  b.radius = b.reach.pixels_x * s->point.across_x;
  b.radius = choose(b.radius * spread > (scalar)0.5, (scalar)0.5 / spread, b.radius);
  b.reach.pixels_x = b.radius / s->point.across_x;
  b.reach.pixels_y = b.radius / s->point.across_y;
  b.per_range = per_range_of(params.range, b.radius);
  b.heights = heights_of(s->point, d->surface, d->axis, b.reach.pixels_x);
  // Positions round by their own size: beside an observer who stands aside, they are far longer than the depth.
  if (!p->is_straight)
    b.heights.rounding += (scalar)0x1p-21 *
                          (fabs(s->stored_position.x) + fabs(s->stored_position.y) + fabs(s->stored_position.z)) *
                          s->point.inverse_depth;
  // Bounds the offsets of all points.
  b.reach = longer(b.reach, (scalar)1.01 * d->surface.length / (1 - b.radius * spread));
  return b;
}

static inline void set_straight_axes(Sphere* b, const Spot* s, Axes axes) {
  const real3 from[3] = {axes.x, axes.y, axes.axis};
  real3 to[3];
  const real x = b->radius / s->point.across_x, y = b->radius / s->point.across_y;
  for (int k = 0; k < 3; ++k)
    to[k] = make3((from[k].x + from[k].z * s->point.ray_x) * x, (from[k].y + from[k].z * s->point.ray_y) * -y,
                  from[k].z * b->radius);
  b->axes.x = to[0];
  b->axes.y = to[1];
  b->axes.axis = to[2];
}

static inline void set_skewed_axes(Sphere* b, PROJECTIONS p, const Spot* s, Axes axes) {
  const real radius = b->radius * s->depth;
  b->axes.x = times3(p->to_physical, scale3(axes.x, radius));
  b->axes.y = times3(p->to_physical, scale3(axes.y, radius));
  b->axes.axis = times3(p->to_physical, scale3(axes.axis, radius));
  b->from_module = physical_of(p, s->position);
}

// Offset of a point in the image, in pixels from the pixel.
static inline __attribute__((always_inline)) void project_point(PROJECTIONS p, const Spot* s, const Sphere* b,
                                                                BallPoint point, int straight, integer* dx,
                                                                integer* dy) {
  const real3 v = direction_of(point, b->axes);
  if (straight) {
    *dx = nearest(v.x * (point.distance * rough_inverse(1 - point.distance * v.z * s->spread_x)));
    *dy = nearest(v.y * (point.distance * rough_inverse(1 - point.distance * v.z * s->spread_y)));
    return;
  }
  const real3 q = make3(b->from_module.x + point.distance * v.x, b->from_module.y + point.distance * v.y,
                        b->from_module.z + point.distance * v.z);
  real x, y;
  mask is_shown;
  project_through_slits(p, q, &x, &y, &is_shown);
  // Light that misses a curved screen has no pixel: the pixel at hand stands for it.
  *dx = nearest(choose(is_shown, x - s->point.x, (real)(0)));
  *dy = nearest(choose(is_shown, y - s->point.y, (real)(0)));
}

// Occlusion of a point, 0 to 1.
static inline __attribute__((always_inline)) real occlusion_at(PROJECTIONS p, Surfaces planes, const Spot* s,
                                                               const Sphere* b, integer dx, integer dy, integer place,
                                                               real height, int straight) {
  const real depth = gather(planes.depth + s->here, place);
#if GATHERS_ONLY
  return depth;
#endif
  const real e = relative_depth(s->point, s->depth, depth);
  mask is_behind;
  if (straight) {
    const real across = to_real(dx) * b->heights.per_x, up = to_real(dy) * b->heights.per_y;
    const real fall = b->heights.fall + s->spread_x * across + s->spread_y * up;
    is_behind = stands_before(e, fall, across + up - height);
  } else {
    const real3 there =
        gather3(planes.position_x + s->here, planes.position_y + s->here, planes.position_z + s->here, place);
    const real3 off = minus3(there, s->stored_position);
    const real above = dot3(s->stored_normal, off) * s->point.inverse_depth;
    // Height above the tangent plane is compared along the light's way to the observers. It is taken for the visible surface, not
    // for the point beside it: on a plane seen edge-on, one way may come down to the plane and the other not.
    const real3 seen = times3(p->to_physical, times3(p->to_view, off));
    const Slopes slopes =
        slopes_through(p, make3(b->from_module.x + seen.x, b->from_module.y + seen.y, b->from_module.z + seen.z));
    const real3 ahead = times3(p->from_physical, make3(slopes.across, slopes.up, (real)(1)));
    is_behind = !is_background(depth) & stands_before((real)(0), -dot3(s->normal, ahead), above - height);
  }
  return choose(is_behind, range_weight(e, b->per_range), (real)(0));
}

static inline __attribute__((always_inline)) real occluded_points(Frame f, PROJECTIONS p, Params params, TABLE points,
                                                                  int first, Surfaces planes, const Spot* s,
                                                                  const Directions* d, const Sphere* b, int straight,
                                                                  int within) {
  const scalar bias = HEMISPHERE ? params.bias : 0;
  real sum = 0;
#pragma unroll 1
  for (int k = 0; k < SAMPLES; ++k) {
    BallPoint point;
    set_point(points, first + k, &d->ball, d->choice, &point);
    integer dx, dy, place;
    project_point(p, s, b, point, straight, &dx, &dy);
    const mask counts = place_sample(f, s, within, &dx, &dy, &place);
    const real height = point.distance * ((point.axis + bias) * b->radius) + b->heights.rounding;
    const real found = occlusion_at(p, planes, s, b, dx, dy, place, height, straight);
    sum += counted(counts, found);
  }
  return sum;
}

static inline real open_share(Frame f, PROJECTIONS p, Params params, TABLE points, Surfaces planes, Spot s) {
  Directions d;
  d.surface = surface_at(s.point, s.normal);
  const real3 n = normal_towards_eye(d.surface, s.normal);
  d.axis = scale3(n, (scalar)1 / sqrt(dot3(n, n)));
  d.ball = ball_of(d.axis, params.inner, s.noise);
  d.choice = choice_of(to_natural(s.x), to_natural(s.y), f.seed);
  // Normals along the axes of the plane `position`, for positions read from it.
  s.normal = d.axis;
  s.stored_normal = transposed_times3(p->to_view, d.axis);
  real most = 0;
  scalar radius = params.radius;
  for (int k = 0; k < RADII; ++k) {
    Sphere b = sphere_at(f, p, params, &s, &d, radius);
    if (p->is_straight)
      set_straight_axes(&b, &s, d.ball.axes);
    else
      set_skewed_axes(&b, p, &s, d.ball.axes);
    real occluded;
    LOOK_THROUGH(occluded, f, p, s, b.reach,
                 occluded_points(f, p, params, points, SAMPLES * k, planes, &s, &d, &b, straight, within))
    most = larger(occluded, most);
    radius *= params.ratio;
  }
  return 1 - most * ((scalar)1 / SAMPLES);
}

#define OPEN_SHARE(f, p, params, planes, spot) open_share(f, p, params, points, planes, spot)

#endif
