// A ray from a surface, as the passes hand it on.
//
// ray_x, _y, _z  direction, unit, view space; ray_density  its density per solid angle, 0 where there is no ray, +inf for a mirror
// list           rays that are followed: layer * floats per layer + pixel (pixel_list.h)
// met            what each ray met: a pixel's index, or a value below; met_in_other  the same in the other eye's image
// left_at        steps after which a ray left this eye's image
// RAYS layers of each.
#ifndef GLOAM_SSR_RAY_H
#define GLOAM_SSR_RAY_H

#include "shared/rays/screen_ray.h"
#if STEREO
#include "shared/frame/neighbour.h"
#endif

// The start of a ray, and the surface that it is compared with.
typedef struct {
  Anchor point;
  real depth;
  real3 direction;     // unit, view space
  real3 from_surface;  // from the reflecting point to the start, in depths; not 0 in the other eye
  real3 normal;        // of the reflecting surface
  real least_sine;     // least sine of the angle to that surface for a hit to be another surface
  ScreenRay line;
} Start;

static inline Start start_at(Frame frame, Params params, real column, real row, real depth, real3 normal,
                             real3 direction, real most_length) {
  Start s;
  s.point = anchor_at(frame, column, row, depth);
  s.depth = depth;
  s.direction = direction;
  s.from_surface = make3((real)(0), (real)(0), (real)(0));
  s.normal = normal;
  s.least_sine = smaller((real)(params.bias), (scalar)0.5 * dot3(direction, normal));
  s.line = screen_ray_of(frame, s.point, depth, direction);
  if (!isinf(params.max_distance)) {
    const real longest = steps_to(frame, s.line, most_length / depth);
    s.line.reaches_infinity &= s.line.end <= longest;
    s.line.end = smaller(s.line.end, longest);
  }
  return s;
}

static inline Start start_of(Frame frame, Params params, real column, real row, real depth, real3 normal,
                             real3 direction) {
  return start_at(frame, params, column, row, depth, normal, direction, (real)(params.max_distance));
}

#if STEREO
static inline real3 point_along(Frame frame, Start s, real length) {
  const real3 p = position_at(frame, s.point.x, s.point.y, s.depth);
  return make3(p.x + s.direction.x * length, p.y + s.direction.y * length, p.z + s.direction.z * length);
}

// The start of a ray in the other eye's image, after `t` steps in this eye's. `length`: of the ray so far, scene units. `goes_on`:
// the start lies in the other's image.
static inline Start start_in_other(Frame frame, Neighbour n, Params params, Start own, real t, mask* goes_on,
                                   real* length) {
  *length = length_at(frame, own.line, t) * own.depth;
  const real3 at = point_along(frame, own, *length);
  const Projection there = project_into(n, at, *goes_on & (*length < FARTHEST * own.depth));
  // Between the outermost pixel centres: at the border of two images that show the same, rounding would decide.
  *goes_on = there.is_seen & (there.x >= 0) & (there.y >= 0) & (there.x <= n.frame.width - 1) &
             (there.y <= n.frame.height - 1);
  const real3 reflector = into_other(n, position_at(frame, own.point.x, own.point.y, own.depth)),
              here = into_other(n, at);
  Start s = start_at(n.frame, params, there.x, there.y, there.depth, rotated(n, own.normal), rotated(n, own.direction),
                     larger(params.max_distance - *length, (real)(0)));
  const real per_depth = (scalar)1 / there.depth;
  s.from_surface =
      make3((here.x - reflector.x) * per_depth, (here.y - reflector.y) * per_depth, (here.z - reflector.z) * per_depth);
  s.least_sine = own.least_sine;
  return s;
}
#endif

// What a ray met, as an int in a plane's memory: the index of the pixel, or one of these.
#define MET_NOTHING 0
#define MET_BACKGROUND -1

// What the rays of a row met.
static inline integer met_in_row(global const float* met, int here) {
#if LANES == 1
  return ((global const int*)met)[here];
#else
  return JOIN(vload, LANES)(0, (global const int*)met + here);
#endif
}

#endif
