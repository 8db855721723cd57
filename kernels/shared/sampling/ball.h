// Points in the ball of the radius around a pixel's point, or in the half of it above the surface, evenly spread over its
// volume: directions on a spherical Fibonacci spiral about the normal (Marques et al. 2013), distances by a second sequence.
// Turned and shifted by the pixel's noise. With `inner` above 0, a shell between two spheres.
// -D SAMPLES, HEMISPHERE, OWN_POINTS
#ifndef GLOAM_BALL_H
#define GLOAM_BALL_H

#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/slice.h"

// Step of the distance sequence: sqrt(3) - 1, times 2^32. Of the irrational numbers tried beside the golden angle, the one with
// the least error over random half spaces, for 8 to 1024 points.
#define DISTANCE_STEP 0xbb67ae85u

// Three vectors that span the points: unit and orthogonal in space, or their images on the screen.
typedef struct {
  real3 x, y, axis;
} Axes;

typedef struct {
  Axes axes;            // in space; `axis` is the surface's normal
  real shift;           // shift of the distances, 0 to 1
  scalar inner_cubed;   // share of the ball that is left out
  scalar cosine, sine;  // of the next point, about the axis
} Ball;

// What a pixel's turn and shift do not change in a point: the same for all pixels, or with OWN_POINTS each pixel's own.
#if OWN_POINTS
typedef real Share;
#else
typedef scalar Share;
#endif

// A point of the ball: its unit direction as shares of the axes, and its distance in radii.
typedef struct {
  Share x, y, axis;
  real distance;
} BallPoint;

// `axis`: unit. The other two axes by Frisvad 2012, then turned: continuous but at the far end of the z axis, where they lose
// their length. Only views of almost 180 degrees see surfaces near there.
static inline Ball ball_of(real3 axis, scalar inner, Noise noise) {
  const real a = (scalar)-1 / larger(1 + axis.z, (real)(1e-3f)), b = axis.x * axis.y * a;
  const real3 x = make3(1 + axis.x * axis.x * a, b, -axis.x);
  const real3 y = make3(b, 1 + axis.y * axis.y * a, -axis.y);
  real cosine, sine;
  cosine_sine_of_turns(noise.turn, &cosine, &sine);
  Ball ball;
  ball.axes.x = make3(cosine * x.x + sine * y.x, cosine * x.y + sine * y.y, cosine * x.z + sine * y.z);
  ball.axes.y = make3(cosine * y.x - sine * x.x, cosine * y.y - sine * x.y, cosine * y.z - sine * x.z);
  ball.axes.axis = axis;
  ball.shift = noise.shift;
  ball.inner_cubed = inner * inner * inner;
  ball.cosine = 1;
  ball.sine = 0;
  return ball;
}

// Distance of the point at this share of the volume, in radii, shifted by the pixel's noise.
static inline real distance_at(const Ball* ball, Share share) {
  const real sum = ball->shift + share;
  const real fraction = choose(sum >= 1, sum - 1, sum);
  return rough_cube_root(ball->inner_cubed + (1 - ball->inner_cubed) * fraction);
}

// Point k of SAMPLES; call with k = 0, 1, ... in order.
static inline BallPoint next_point(Ball* ball, int k) {
  BallPoint p;
  p.axis = HEMISPHERE ? (k + (scalar)0.5) * ((scalar)1 / SAMPLES) : 1 - (2 * k + 1) * ((scalar)1 / SAMPLES);
  const Share sine = sqrt(1 - p.axis * p.axis);
  p.x = sine * ball->cosine;
  p.y = sine * ball->sine;
  p.distance = distance_at(ball, (scalar)(((uint)k * DISTANCE_STEP) >> 8) * (scalar)0x1p-24f);
  turn_golden(&ball->cosine, &ball->sine);
  return p;
}

// The point's direction in terms of these axes.
static inline real3 direction_of(BallPoint p, Axes a) {
  return make3(p.x * a.x.x + p.y * a.y.x + p.axis * a.axis.x, p.x * a.x.y + p.y * a.y.y + p.axis * a.axis.y,
               p.x * a.x.z + p.y * a.y.z + p.axis * a.axis.z);
}

// The ball as the screen shows it.
typedef struct {
  Axes axes;                // pixels to the right and down, and how much nearer to the eye in depths of the pixel
  real pixels_x, pixels_y;  // radius at the pixel's depth
  real radius;              // radius in units of that depth
  real nearer;              // the same for a perspective camera, else 0
} BallOnScreen;

// Screen image of a vector as long as the radius.
static inline real3 on_screen(BallOnScreen b, Anchor a, real3 v) {
  return make3((v.x + v.z * a.ray_x) * b.pixels_x, (v.y + v.z * a.ray_y) * -b.pixels_y, v.z * b.nearer);
}

// As large as the reach on both axes allows, and at most half the pixel's depth, so that every point lies before the eye.
static inline BallOnScreen ball_on_screen(Frame f, Anchor a, Reach reach, Axes axes) {
  BallOnScreen b;
  b.pixels_x = smaller(reach.pixels_x, reach.pixels_y * (f.scale_y / f.scale_x));
  if (f.perspective > 0) b.pixels_x = smaller(b.pixels_x, (real)((scalar)0.5 / f.scale_x));
  b.pixels_y = b.pixels_x * (f.scale_x / f.scale_y);
  b.radius = b.pixels_x * a.across_x;
  b.nearer = b.pixels_x * (f.scale_x * f.perspective);
  b.axes.x = on_screen(b, a, axes.x);
  b.axes.y = on_screen(b, a, axes.y);
  b.axes.axis = on_screen(b, a, axes.axis);
  return b;
}

// Offset of a point on the screen, in pixels from the pixel.
static inline void project(BallOnScreen b, BallPoint p, integer* dx, integer* dy) {
  const real3 v = direction_of(p, b.axes);
  const real scale = p.distance * rough_inverse(1 - p.distance * v.z);
  *dx = nearest(v.x * scale);
  *dy = nearest(v.y * scale);
}

// A bound on the offsets of all points, a little larger for the rounding of the axes.
static inline Reach reach_of_ball(BallOnScreen b, Surface s) {
  Reach reach;
  reach.pixels_x = b.pixels_x;
  reach.pixels_y = b.pixels_y;
  reach.inverse_square = 0;
  return longer(reach, (scalar)1.01 * s.length / (1 - b.nearer));
}

#endif
