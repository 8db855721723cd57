// Sample positions, and their noise from pixel to pixel: the same seed gives the same image on every device and lane width.
#ifndef GLOAM_SAMPLE_H
#define GLOAM_SAMPLE_H

#include "shared/frame/camera.h"
#include "shared/lanes/math.h"

// The upper 24 bits as 0 <= u < 1: exact in float.
static inline real unit_random(natural bits) { return to_real(bits >> 8) * (scalar)0x1p-24; }

// Two numbers per pixel, 0 <= each < 1, spread evenly over any few neighbouring pixels, so that a small filter averages all
// directions: rank-1 lattices. `turn` has the steps of interleaved gradient noise (Jimenez 2014), `shift` those of the R2
// sequence (Roberts 2018). Integer arithmetic: the same on every device, in float and in double.
typedef struct {
  real turn, shift;
} Noise;

static inline Noise noise_at(integer x, integer y, int seed) {
  Noise n;
#if JITTER
  const natural column = to_natural(x), row = to_natural(y);
  const uint first_turn = (uint)seed * 0x9e3779b9u, first_shift = (uint)seed * 0x6a09e667u;
  n.turn = unit_random(column * 0x8e42b7fdu + (row * 0x4f2cbe3cu + first_turn));
  n.shift = unit_random(column * 0xc13fa9a9u + (row * 0x91e10da6u + first_shift));
#else
  n.turn = (real)(0);
  n.shift = (real)(0.5f);
#endif
  return n;
}

// Turns by the golden angle, the step between points of a Fibonacci spiral.
static inline void turn_golden(scalar* cosine, scalar* sine) {
  const scalar step_cosine = (scalar)-0.7373688780783197, step_sine = (scalar)0.6754902942615238;
  const scalar next = *cosine * step_cosine - *sine * step_sine;
  *sine = *sine * step_cosine + *cosine * step_sine;
  *cosine = next;
}

// Reach of a radius on the screen, in pixels along each axis, capped.
typedef struct {
  real pixels_x, pixels_y;
  real inverse_square;  // 1 / (radius / depth)^2
} Reach;

// A radius of 0 reaches no pixel; an infinite one reaches up to the cap. Distances of 1e15 depths and more are out of reach even
// of an infinite radius, so that background never counts.
static inline Reach reach_of(Frame f, Anchor a, scalar radius, scalar most_pixels) {
  Reach r;
  const real relative = (scalar)radius * a.inverse_depth;
  const real per_depth = f.perspective * a.inverse_depth + f.parallel;
  r.pixels_x = smaller(((scalar)radius / f.scale_x) * per_depth, (real)(most_pixels));
  r.pixels_y = smaller(((scalar)radius / f.scale_y) * per_depth, (real)(most_pixels));
  const real inverse = larger(quick_inverse(larger(relative, (real)(1e-18f))), (real)(1e-15f));
  r.inverse_square = inverse * inverse;
  return r;
}

static inline Reach longer(Reach r, real factor) {
  r.pixels_x *= factor;
  r.pixels_y *= factor;
  return r;
}

// How the samples of a work-item are read, a compile-time constant: a loop over samples is written once and compiled once per
// mode. (A single loop for all modes is a sixth slower on AVX-512.)
#define SAMPLES_INSIDE 0         // every sample of every lane lies in the frame
#define SAMPLES_CLAMPED 1        // some are moved onto its border
#define SAMPLES_IN_WIDE_FRAME 2  // as SAMPLES_CLAMPED, in a wide frame (load.h)

// Whether the reach of every lane's pixel lies within the frame.
static inline int reaches_only_inside(Frame f, Anchor a, Reach r) {
  // One pixel for rounding, and one because samples may start one pixel away even with a shorter reach.
  const real x = r.pixels_x + 2, y = r.pixels_y + 2;
  // Negated, so that NaN counts as outside.
  return !ANY(!((a.x >= x) & (a.x + x < (scalar)f.width) & (a.y >= y) & (a.y + y < (scalar)f.height)));
}

// Clamps an offset in pixels from each lane's (x, y) to the frame. Returns which samples count: all, or with OUTSIDE_OPEN only
// those that were within the frame. `within`: one of the constants above.
static inline mask keep_in_frame(Frame f, integer x, integer y, int within, integer* dx, integer* dy) {
  if (within == SAMPLES_INSIDE) return EVERY_LANE;
  const integer kept_x = min(max(*dx, -x), f.width - 1 - x), kept_y = min(max(*dy, -y), f.height - 1 - y);
#if OUTSIDE_OPEN
  const mask inside = to_mask((kept_x == *dx) & (kept_y == *dy));
#else
  const mask inside = EVERY_LANE;
#endif
  *dx = kept_x;
  *dy = kept_y;
  return inside;
}

// A sample's contribution; 0 where the sample does not count.
static inline real counted(mask counts, real found) {
#if OUTSIDE_OPEN
  return choose(counts, found, (real)(0));
#else
  return found;
#endif
}

// Index, from the first lane's, of an offset that stays in the frame. |dy| is below 32768.
static inline integer index_within(Frame f, int within, integer dx, integer dy) {
  return within == SAMPLES_IN_WIDE_FRAME ? index_near(f, dx, dy) : index_near_short(f, dx, dy);
}

// A plane's value at an offset that stays in the frame; `here` is the first lane's index.
static inline real sample_near(PLANE plane, Frame f, int here, int within, integer dx, integer dy) {
  return gather(plane + here, index_within(f, within, dx, dy));
}

#endif
