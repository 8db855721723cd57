// Ambient occlusion for light-field displays (Doronin, Kara, Barsi, Martini 2017). A display's module has no eye: from an
// image and its depths no matrix leads back to points. So a point is taken from the plane `position`, and only the map from
// points to pixels is asked (Algorithm 2; shared/projection.h). With a camera's map it is what `ssao` and `hbao+` are.
//
// lightfield_ssao_estimate       share of the points in balls around the pixel's point with something seen before them; of
//                                several radii (section 6, after Hoang, Low 2010) the one that takes most
// lightfield_hbao_plus_estimate  mean obscurance over directions x steps in the image
// in : depth     planar distance, scene units, +inf = background
//      normal    unit, view space
//      position  scene units, the world's axes
//      points    of the balls: x, y, share of the axis, share of the volume; SAMPLES for each of RADII
// out: ao_raw    1 = open .. 0 = closed, unfiltered; 1 on background
// ..._list: the same for the pixels of a list (shared/pixel_list.h), whatever their order
//
// lightfield_find: where something within the radius may occlude, as `corner-mask` asks it, one pixel for each cell
// in : depth, normal, position  of the pixels that stand for cells (lightfield_subsample)
// out: found     1 where something rises over the tangent plane, else 0; 0 on background; then shared/cells.h
//
// lightfield_reuse: what key views show of the same points
// in : key_depth, key_position, key_ao      of the nearest key view; far_...: of the next one on the other side
// out: ao_raw    of the first of them that shows the point; else 1, and the pixel is in `newly_visible`
// -D ESTIMATE (1: ssao, 2: hbao+, 3: the mask), REUSE, MASKED (wanted.h), OUTSIDE_OPEN, JITTER, SCALE (pixels per cell); SAMPLES, RADII, HEMISPHERE; DIRECTIONS, STEPS, NO_FALLOFF
#include "estimators/ball.h"
#include "estimators/obscurance.h"
#include "lightfield/params.h"
#include "shared/pixel_list.h"
#include "shared/projection.h"
#if ESTIMATE == 1
typedef LightfieldSsaoParams Params;
#include "shared/ball.h"
#elif ESTIMATE == 2
typedef LightfieldHbaoPlusParams Params;
#else
typedef LightfieldMaskParams Params;
#endif
#if ESTIMATE > 1
#include "shared/fan.h"
#endif
#if ESTIMATE == 3
#include "shared/cells.h"
#include "shared/subsample.h"
#endif

// The planes that tell surfaces.
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
  int here;        // an index, from which on
  integer places;  // they lie
  real depth;
  real3 normal, position;  // view space
  real3 stored_position;   // the plane's
  real3 stored_normal;     // the normal in that plane's axes
  Anchor point;            // of what is around, in depths of the pixel
  // How much faster than depth distances across and up grow: 1 with one eye, 0 without; negative of slits
  real spread_x, spread_y;
  Noise noise;
} Spot;

// What is seen one pixel aside, and along the pixel's own ray, where both change evenly over the image.
static inline void set_straight(Spot* s, Frame f, PROJECTIONS p) {
  const real wide = p->grow_x * s->depth + p->base_x, high = p->grow_y * s->depth + p->base_y;
  s->point.across_x = p->scale_x * wide * s->point.inverse_depth;
  s->point.across_y = p->scale_y * high * s->point.inverse_depth;
  s->point.ray_x = p->grow_x * (s->position.x - p->origin_x) / wide;
  s->point.ray_y = p->grow_y * s->position.y / high;
  s->spread_x = p->grow_x * s->depth / wide;
  s->spread_y = p->grow_y * s->depth / high;
}

// Where they do not: about the point itself.
static inline void set_skewed(Spot* s, Frame f, PROJECTIONS p) {
  const real3 q = physical_of(p, s->position);
  // Towards the middle of a curved screen: on the other side there may be none.
  const real far = (scalar)(1.0f / 64) * s->depth, step = choose(q.x > 0, -far, far);
  real x, y, right, up, aside;
  mask unused;
  place_through_slits(p, q, &x, &y, &unused);
  place_through_slits(p, physical_of(p, make3(s->position.x + step, s->position.y, s->position.z)), &right, &aside,
                      &unused);
  place_through_slits(p, physical_of(p, make3(s->position.x, s->position.y + step, s->position.z)), &aside, &up,
                      &unused);
  s->point.across_x = (scalar)(1.0f / 64) / larger(fabs(right - x), (real)(1e-6f));
  s->point.across_y = (scalar)(1.0f / 64) / larger(fabs(up - y), (real)(1e-6f));
  const Slopes slopes = slopes_through(p, q);
  const real3 ahead = times3(p->from_physical, make3(slopes.across, slopes.up, (real)(1)));
  s->point.ray_x = -ahead.x / ahead.z;
  s->point.ray_y = -ahead.y / ahead.z;
  // For bounds alone: how near the module and the observers are.
  s->spread_x = -(p->observer_ahead - q.z) / q.z;
  s->spread_y = (real)(1);
}

static inline void finish_spot(Spot* s, Frame f, PROJECTIONS p) {
  s->position = view_of_position(p, s->stored_position);
  // Where nothing is seen, or what can only be an error, any point will do that has a place.
  const mask background = is_background(s->depth) | !has_place(p, s->depth, s->position);
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
  s->noise = noise_of(to_natural(s->x), to_natural(s->y), f.seed);
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

// Moves an offset onto the image, and makes it an index from `here`. Returns which samples count (keep_in_frame, sample.h).
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

// RESULT = CALL, with `straight` and `within` as constants that hold for all samples up to `widest`.
#define LOOK_THROUGH(RESULT, f, p, spot, widest, CALL)       \
  if (!(p)->is_straight) {                                   \
    const int straight = 0, within = SAMPLES_IN_WIDE_FRAME;  \
    RESULT = CALL;                                           \
  } else if ((f).pitch >= SHORT_PITCH) {                     \
    const int straight = 1, within = SAMPLES_IN_WIDE_FRAME;  \
    RESULT = CALL;                                           \
  } else if (reaches_only_inside(f, (spot).point, widest)) { \
    const int straight = 1, within = SAMPLES_INSIDE;         \
    RESULT = CALL;                                           \
  } else {                                                   \
    const int straight = 1, within = SAMPLES_CLAMPED;        \
    RESULT = CALL;                                           \
  }

// A radius in scene units as the image shows it, in pixels of each axis, capped (reach_of, sample.h).
static inline Reach reach_in_image(Frame f, const Spot* s, scalar radius, scalar max_reach) {
  const real most = (real)(max_reach * (scalar)f.width), relative = radius * s->point.inverse_depth;
  Reach r;
  r.pixels_x = smaller(relative / s->point.across_x, most);
  r.pixels_y = smaller(relative / s->point.across_y, most);
  const real inverse = larger(quick_inverse(larger(relative, (real)(1e-18f))), (real)(1e-15f));
  r.inverse_square = inverse * inverse;
  return r;
}

// ---------------------------------------------------------------------------------------------------------------------
#if ESTIMATE == 1

#define TABLE constant float*

typedef struct {
  Surface surface;
  real3 axis;
  Ball ball;
} Directions;

// One ball in the image.
typedef struct {
  Axes axes;  // straight: pixels to the right and down, and in depths how much nearer; skewed: physical
  real3 from_module;
  Heights heights;
  Reach reach;
  real radius;  // in depths
  real per_range;
} Sphere;

// As large as the reach on both axes allows, and so small that it lies before the observers and the module by half at least.
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
  // Positions are rounded by their own size, whatever the depth: beside an observer who stands aside they are far longer.
  if (!p->is_straight)
    b.heights.rounding += (scalar)0x1p-21 *
                          (fabs(s->stored_position.x) + fabs(s->stored_position.y) + fabs(s->stored_position.z)) *
                          s->point.inverse_depth;
  // What bounds the offsets of all points.
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

// Where the image shows a point, in pixels from the pixel.
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
  place_through_slits(p, q, &x, &y, &is_shown);
  // Light that misses a curved screen has no place: the pixel itself stands for it.
  *dx = nearest(choose(is_shown, x - s->point.x, (real)(0)));
  *dy = nearest(choose(is_shown, y - s->point.y, (real)(0)));
}

// How much a point is occluded, 0 to 1.
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
    // Along the light's way to the observers height grows by what it falls along depth: along that of what is seen, which lies
    // beside the point's. Of the two, on a plane that is seen edge-on, one may come down to it and the other not.
    const real3 seen = times3(p->to_physical, times3(p->to_view, off));
    const Slopes slopes =
        slopes_through(p, make3(b->from_module.x + seen.x, b->from_module.y + seen.y, b->from_module.z + seen.z));
    const real3 ahead = times3(p->from_physical, make3(slopes.across, slopes.up, (real)(1)));
    is_behind = !is_background(depth) & stands_before((real)(0), -dot3(s->normal, ahead), above - height);
  }
  return choose(is_behind, range_weight(e, b->per_range), (real)(0));
}

static inline __attribute__((always_inline)) real occluded_points(Frame f, PROJECTIONS p, Params params, TABLE points,
                                                                  Surfaces planes, const Spot* s, const Directions* d,
                                                                  const Sphere* b, int straight, int within) {
  const scalar bias = HEMISPHERE ? params.bias : 0;
  real sum = 0;
#pragma unroll 1
  for (int k = 0; k < SAMPLES; ++k) {
    BallPoint point;
    point.x = points[4 * k];
    point.y = points[4 * k + 1];
    point.axis = points[4 * k + 2];
    point.distance = distance_at(&d->ball, points[4 * k + 3]);
    integer dx, dy, place;
    project_point(p, s, b, point, straight, &dx, &dy);
    const mask counts = place_sample(f, s, within, &dx, &dy, &place);
    const real height = point.distance * ((point.axis + bias) * b->radius) + b->heights.rounding;
    const real found = occlusion_at(p, planes, s, b, dx, dy, place, height, straight);
    sum += OUTSIDE_OPEN ? choose(counts, found, (real)(0)) : found;
  }
  return sum;
}

static inline real open_share(Frame f, PROJECTIONS p, Params params, TABLE points, Surfaces planes, Spot s) {
  Directions d;
  d.surface = surface_at(s.point, s.normal);
  const real3 n = normal_towards_eye(d.surface, s.normal);
  d.axis = scale3(n, (scalar)1 / sqrt(dot3(n, n)));
  d.ball = ball_of(d.axis, params.inner, s.noise);
  // The plane's axes serve what is read from that plane.
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
                 occluded_points(f, p, params, points + 4 * SAMPLES * k, planes, &s, &d, &b, straight, within))
    most = larger(occluded, most);
    radius *= params.ratio;
  }
  return 1 - most * ((scalar)1 / SAMPLES);
}

#define POINTS_ARGUMENT TABLE points,
#define OPEN_SHARE(f, p, params, planes, spot) open_share(f, p, params, points, planes, spot)

#endif
// ---------------------------------------------------------------------------------------------------------------------
#if ESTIMATE > 1

// From the point to what is seen at an offset in pixels, in depths, and the normal in the same axes; background is far away.
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
#if ESTIMATE == 2

static inline __attribute__((always_inline)) real obscurance_at(Params params, Surfaces planes, const Spot* s,
                                                                Reach reach, integer dx, integer dy, integer place,
                                                                int straight) {
  const real depth = gather(planes.depth + s->here, place);
#if GATHERS_ONLY
  return depth;
#endif
  real3 v, normal;
  look_at(planes, s, depth, dx, dy, place, straight, &v, &normal);
  return obscurance(v, normal, params.bias, reach.inverse_square);
}

static inline __attribute__((always_inline)) real sum_of_obscurance(Frame f, Params params, Surfaces planes,
                                                                    const Spot* s, Reach reach, Fan fan, int straight,
                                                                    int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy, place;
      step_at(fan, k, &dx, &dy);
      const mask counts = place_sample(f, s, within, &dx, &dy, &place);
      const real found = obscurance_at(params, planes, s, reach, dx, dy, place, straight);
      sum += OUTSIDE_OPEN ? choose(counts, found, (real)(0)) : found;
    }
    turn(&fan);
  }
  return sum;
}

static inline real open_share(Frame f, PROJECTIONS p, Params params, Surfaces planes, Spot s) {
  real sum;
  const Reach reach = reach_in_image(f, &s, params.radius, params.max_reach);
  const Fan fan = fan_of(reach, s.noise);
  LOOK_THROUGH(sum, f, p, s, reach, sum_of_obscurance(f, params, planes, &s, reach, fan, straight, within))
  return 1 - sum * (params.strength * 2 / (DIRECTIONS * STEPS));
}

#define POINTS_ARGUMENT
#define OPEN_SHARE(f, p, params, planes, spot) open_share(f, p, params, planes, spot)

#endif
// ---------------------------------------------------------------------------------------------------------------------
#if ESTIMATE == 3

kernel void lightfield_subsample(Frame frame, Frame other, Params params, PLANE depth, PLANE normal_x, PLANE normal_y,
                                 PLANE normal_z, PLANE position_x, PLANE position_y, PLANE position_z,
                                 PLANE_OUT low_depth, PLANE_OUT low_normal_x, PLANE_OUT low_normal_y,
                                 PLANE_OUT low_normal_z, PLANE_OUT low_position_x, PLANE_OUT low_position_y,
                                 PLANE_OUT low_position_z) {
  subsample_surface(frame, other, depth, normal_x, normal_y, normal_z, low_depth, low_normal_x, low_normal_y,
                    low_normal_z);
  subsample_vector(frame, other, position_x, position_y, position_z, low_position_x, low_position_y, low_position_z);
}

// Whether in any direction something rises as high as counts. Ends where that is so for each lane.
static inline __attribute__((always_inline)) real something_rises(Frame f, Params params, Surfaces planes,
                                                                  const Spot* s, Fan fan, real farthest, int straight,
                                                                  int within) {
  mask rises = s->point.background;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy, place;
      step_at(fan, k, &dx, &dy);
      const mask counts = place_sample(f, s, within, &dx, &dy, &place);
      real3 v, normal;
      look_at(planes, s, gather(planes.depth + s->here, place), dx, dy, place, straight, &v, &normal);
      const real height = fused_dot3(normal, v), square = square_of(v);
      rises |= counts & (height > 0) & (square < farthest) &
               (height * height > params.least_sine * params.least_sine * square);
    }
    if (!ANY(!rises)) break;
    turn(&fan);
  }
  return choose(rises & !s->point.background, (real)(1), (real)(0));
}

kernel void lightfield_find(Frame frame, PROJECTIONS projections, Params params, PLANE depth, PLANE normal_x,
                            PLANE normal_y, PLANE normal_z, PLANE position_x, PLANE position_y, PLANE position_z,
                            PLANE_OUT found) {
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  const Spot s = spot_in_row(frame, projections, planes, normal_x, normal_y, normal_z);
  real rises = 0;
  // Nothing is within a radius of 0, not even what lies in the same cell.
  if (params.radius > 0 && ANY(!s.point.background)) {
    const Reach reach = reach_in_image(frame, &s, params.radius, params.max_reach);
    // Both cells stand for pixels that may be nearer to one another. Background is out of any reach.
    const real farthest = 1 / sqrt(reach.inverse_square) + s.point.across_x + s.point.across_y;
    const Fan fan = fan_of(reach, s.noise);
    LOOK_THROUGH(rises, frame, projections, s, reach,
                 something_rises(frame, params, planes, &s, fan, farthest * farthest, straight, within))
  }
  store(rises, found, s.here);
}

#endif
// ---------------------------------------------------------------------------------------------------------------------

static inline real open_or_background(const Spot* s, real open) {
  return choose(s->point.background, (real)(1), smaller(larger(open, (real)(0)), (real)(1)));
}

#if ESTIMATE == 1
#define ESTIMATE_NAME lightfield_ssao_estimate
#elif ESTIMATE == 2
#define ESTIMATE_NAME lightfield_hbao_plus_estimate
#endif

#if ESTIMATE < 3
kernel void ESTIMATE_NAME(Frame frame, PROJECTIONS projections, Params params, POINTS_ARGUMENT PLANE depth,
                          PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE position_x, PLANE position_y,
                          PLANE position_z, WANTED_ARGUMENT PLANE_OUT ao_raw) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  Spot s = spot_in_row(frame, projections, planes, normal_x, normal_y, normal_z);
  s.point.background |= !is_wanted;
  real open = 1;
  if (ANY(!s.point.background)) open = OPEN_SHARE(frame, projections, params, planes, s);
  store(open_or_background(&s, open), ao_raw, s.here);
}

#if REUSE
kernel void JOIN(ESTIMATE_NAME, _list)(Frame frame, PROJECTIONS projections, Params params, POINTS_ARGUMENT PLANE depth,
                                       PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE position_x,
                                       PLANE position_y, PLANE position_z, PIXEL_LIST newly_visible, PLANE_OUT ao_raw) {
  integer index;
  if (!pixels_of_item(newly_visible, frame, &index)) return;
  const Surfaces planes = surfaces_of(depth, position_x, position_y, position_z);
  const Spot s = spot_of_list(frame, projections, planes, normal_x, normal_y, normal_z, index);
  const real open = OPEN_SHARE(frame, projections, params, planes, s);
  scatter(open_or_background(&s, open), ao_raw, index);
}
#endif
#endif

#if REUSE
// Pixels as far away as the nearest one, to within so many radii, count as the same surface.
#define SAME_DEPTH ((scalar)0.1f)

// A plane between pixels, of those around a place that show the same surface as the nearest, at `nearest_place` and at this depth.
static inline real fetched_at(Frame f, real x, real y, integer nearest_place, real depth, scalar tolerance,
                              global const float* depths, global const float* plane) {
  // In 256ths of a pixel, so that what rounding moves off a pixel's centre is that pixel.
  const real snapped_x = to_real(nearest(x * 256)) * (scalar)(1.0f / 256);
  const real snapped_y = to_real(nearest(y * 256)) * (scalar)(1.0f / 256);
  const integer column = nearest(floor(snapped_x)), row = nearest(floor(snapped_y));
  const real right = snapped_x - to_real(column), below = snapped_y - to_real(row);
  real sum = 0, weights = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const int i = k % 2, j = k / 2;
    const real weight = (i ? right : 1 - right) * (j ? below : 1 - below);
    const integer to_x = clamp(column + i, (integer)(0), (integer)(f.width - 1));
    const integer to_y = clamp(row + j, (integer)(0), (integer)(f.height - 1));
    // Rows are the same in all modules of a straight display.
    if (!ANY(weight > 0)) continue;
    const integer place = FRAME_GUARD + to_y * f.pitch + to_x;
    const mask counts = fabs(gather(depths, place) - depth) <= tolerance;
    sum += choose(counts, weight * gather(plane, place), (real)(0));
    weights += choose(counts, weight, (real)(0));
  }
  const mask is_known = weights > (scalar)0x1p-8f;
  return choose(is_known, sum / choose(is_known, weights, (real)(1)), gather(plane, nearest_place));
}

// What a key view has at the pixel where it shows a point (view space of the pixel at hand), and whether it shows that point: the
// way back from what it shows there ends within `back_check` pixels of the pixel.
static inline real found_in(Frame f, PROJECTIONS own, PROJECTIONS key, Params params, real x, real y, real3 v,
                            mask is_asked, Surfaces planes, global const float* ao, mask* is_found) {
  real there_x, there_y, back_x, back_y;
  mask is_inside, is_back;
  place_in(key, f, into_view(key, v), is_asked, &there_x, &there_y, &is_inside);
  *is_found = is_inside;
  if (!ANY(is_inside)) return (real)(1);
  const integer column = nearest(there_x), row = nearest(there_y);
  const integer place = FRAME_GUARD + row * f.pitch + column;
  const real depth = gather(planes.depth, place);
  const mask is_surface = is_inside & !is_background(depth);
  real3 seen;
  if (key->is_straight)
    seen = point_at(key, to_real(column), to_real(row), choose(is_surface, depth, (real)(1)));
  else
    seen = view_of_position(key, gather3(planes.position_x, planes.position_y, planes.position_z, place));
  place_in(own, f, back_from_view(key, seen), is_surface, &back_x, &back_y, &is_back);
  const real dx = back_x - x, dy = back_y - y;
  *is_found = is_back & (dx * dx + dy * dy <= params.back_check * params.back_check);
  if (!ANY(*is_found)) return (real)(1);
  return fetched_at(f, there_x, there_y, place, depth, SAME_DEPTH * params.radius, planes.depth, ao);
}

// What a key view shows of what was computed for all.
kernel void lightfield_key(Frame frame, Params params, PLANE ao_of_key, WANTED_ARGUMENT PLANE_OUT ao_raw) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  store(choose(is_wanted, load(ao_of_key, here), (real)(1)), ao_raw, here);
}

kernel void lightfield_reuse(Frame frame, PROJECTIONS projections, Params params, PLANE depth, PLANE position_x,
                             PLANE position_y, PLANE position_z, PLANE key_depth, PLANE key_position_x,
                             PLANE key_position_y, PLANE key_position_z, PLANE key_ao, PLANE far_depth,
                             PLANE far_position_x, PLANE far_position_y, PLANE far_position_z, PLANE far_ao,
                             WANTED_ARGUMENT PLANE_OUT ao_raw, PIXEL_LIST_OUT newly_visible) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const mask in_row = to_mask(FIRST_X + IOTA < frame.width);
  const mask is_surface = is_wanted & in_row & !is_background(load(depth, here));
  const real3 v = view_of_position(projections, load3(position_x, position_y, position_z, here));
  mask is_found, is_found_far = (mask)(0);
  real open = found_in(frame, projections, projections + 1, params, x, y, v, is_surface,
                       surfaces_of(key_depth, key_position_x, key_position_y, key_position_z), key_ao, &is_found);
  const mask is_left = is_surface & !is_found;
  if (ANY(is_left)) {
    const real far =
        found_in(frame, projections, projections + 2, params, x, y, v, is_left,
                 surfaces_of(far_depth, far_position_x, far_position_y, far_position_z), far_ao, &is_found_far);
    open = choose(is_found_far, far, open);
    is_found |= is_found_far;
  }
  store(choose(is_found, open, (real)(1)), ao_raw, here);
  append_pixels(newly_visible, here, is_surface & !is_found);
}
#endif
