// The ray from a pixel's point towards the light, as steps from pixel to pixel, and what lies on it.
// -D POINT (a light at a place)
//
// light  three numbers, view space: the unit direction towards the light, or with POINT its place, scene units
#ifndef GLOAM_LIGHT_RAY_H
#define GLOAM_LIGHT_RAY_H

#include "shared/rays/screen_ray.h"
#include "shared/sampling/sample.h"

// A surface that light from lower above its tangent plane does not reach: sine of the light's elevation. Light along the surface
// brings next to nothing, and rounding must not decide whether it arrives.
#define GRAZING ((scalar)1e-3f)

// Shadow rays end this share of the distance before a light at a place, which may stand on a surface.
#define BEFORE_LIGHT ((scalar)1e-4f)

// Relative nearness of the end of a ray that leads to infinity: a little nearer, so that background is behind it.
#define NEXT_TO_INFINITY ((scalar)-0.9999995f)

typedef struct {
  integer x;
  int y, here;
  real depth;
  real3 normal;
  Anchor point;
  real facing;    // cosine between the normal and the direction towards the light
  mask faces;     // the light can arrive: the surface faces it, or its normal is unknown
  mask at_light;  // the light is at the point itself
  ScreenRay line;
  real least, most;  // nearness relative to the start, on the ray to its end
  real last;         // steps to the end of the ray
  real length;       // of what counts as near, in depths of the point
} LightRay;

// Unit direction towards the light, and the distance to it in depths of the point. The same bits in every mode.
static inline real3 towards_light(PLANE light, Frame f, Anchor a, real* distance) {
#if POINT
  const real3 v = make3((scalar)light[0] * a.inverse_depth - (a.x + (scalar)0.5 - f.centre_x) * a.across_x,
                        (scalar)light[1] * a.inverse_depth - (f.centre_y - a.y - (scalar)0.5) * a.across_y,
                        (scalar)light[2] * a.inverse_depth + 1);
  // Scaled first: the square of a distance could overflow, or vanish.
  const real most = larger(larger(fabs(v.x), fabs(v.y)), fabs(v.z));
  const mask apart = (most > 0) & (most < REAL_INFINITY);
  const real3 scaled =
      choose3(apart, scale3(v, 1 / choose(apart, most, (real)(1))), make3((real)(0), (real)(0), (real)(1)));
  const real length = sqrt(dot3(scaled, scaled));
  *distance = choose(apart, most * length, (real)(0));
  return scale3(scaled, 1 / length);
#else
  *distance = REAL_INFINITY;
  return make3((real)(light[0]), (real)(light[1]), (real)(light[2]));
#endif
}

// `longest`: scene units; `most_pixels`: on the screen.
static inline LightRay light_ray_at(Frame f, PLANE light, scalar longest, scalar most_pixels, PLANE depth, PLANE normal_x,
                                    PLANE normal_y, PLANE normal_z) {
  LightRay r;
  r.x = FIRST_X + IOTA;
  r.y = ROW_Y;
  r.here = index_of(f, FIRST_X, r.y);
  r.depth = load(depth, r.here);
  r.normal = load3(normal_x, normal_y, normal_z, r.here);
  r.point = anchor_at(f, to_real(r.x), (real)(r.y), r.depth);
  real distance;
  const real3 direction = towards_light(light, f, r.point, &distance);
  r.at_light = !(distance > 0);
  const mask is_known = dot3(r.normal, r.normal) > (scalar)0.5;
  r.facing = dot3(r.normal, direction);
  r.faces = !is_known | (r.facing > GRAZING);
  r.line = screen_ray_of(f, r.point, choose(r.point.background, (real)(1), r.depth), direction);
  r.length = smaller((scalar)longest * r.point.inverse_depth, (real)(FARTHEST));
  const real near = smaller(r.length, distance * (1 - BEFORE_LIGHT));
  // Towards the eye a ray ends at the plane of the eye, which no image shows.
  const real left = 1 + f.perspective * r.line.growth * near;
  const real steps = choose(left > 0, steps_to(f, r.line, near), REAL_INFINITY);
  r.last = smaller(smaller(r.line.end, (real)(most_pixels)), steps);
  const real end = f.perspective > 0 ? larger(r.line.slope * r.last, (real)(NEXT_TO_INFINITY)) : r.line.slope * r.last;
  r.least = smaller(end, (real)(0));
  r.most = larger(end, (real)(0));
  return r;
}

// A sample of the ray: the pixel nearest to it after a whole number of steps.
typedef struct {
  real e;            // relative depth of what the pixel shows
  real3 offset;      // from the point to what the pixel shows, in depths of the point
  real least, most;  // nearness of the ray relative to its start, where it passes the pixel
  mask counts;       // the pixel lies on the ray
} OnRay;

// `share`: of the ray, 0 to 1; `around`: steps to either side that the sample stands for.
static inline OnRay sample_on(LightRay r, Frame f, PLANE depth, real share, real around) {
  OnRay s;
  const real place = larger(rint(share * r.last), (real)(1));
  s.counts = place <= r.last;
  const real steps = choose(s.counts, place, (real)(0));
  const integer dx = clamp(nearest(r.line.per_x * steps), -r.x, f.width - 1 - r.x);
  const integer dy = clamp(nearest(r.line.per_y * steps), (integer)(-r.y), (integer)(f.height - 1 - r.y));
  s.e = relative_depth(r.point, r.depth, gather(depth + r.here, index_near(f, dx, dy)));
  s.offset = towards_near(f, r.point, to_real(dx), to_real(dy), s.e);
  const real middle = r.line.slope * steps, beside = fabs(r.line.slope) * around;
  s.least = larger(middle - beside, r.least);
  s.most = smaller(middle + beside, r.most);
  return s;
}

// (1 + n)(1 + e) - 1, or n + e for an orthographic camera: below 0 where a place of the ray with the relative nearness n is deeper than
// the relative depth e, above 0 where it is nearer.
static inline real nearer_than(Frame f, real n, real e) { return n + e + f.perspective * n * e; }

// Whether the ray passes what a sample shows, between `behind` its front and `before` it, in depths of the point.
static inline mask passes(Frame f, OnRay s, real before, real behind) {
  return s.counts & (nearer_than(f, s.least, s.e - before) < 0) & (nearer_than(f, s.most, s.e + behind) > 0);
}

// Whether a sample rises over the surface's tangent plane by an elevation with at least this sine.
static inline mask rises_by(LightRay r, OnRay s, scalar sine) {
  const real height = dot3(r.normal, s.offset);
  return (height > 0) & (height * height > sine * sine * dot3(s.offset, s.offset));
}

#endif
