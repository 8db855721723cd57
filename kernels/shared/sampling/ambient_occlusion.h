// What estimates of ambient occlusion have in common: parameters, receivers, and how the result is stored.
#ifndef GLOAM_AMBIENT_OCCLUSION_H
#define GLOAM_AMBIENT_OCCLUSION_H

#include "shared/both/params.h"

// Parameters of every technique that samples around a pixel.
#define REACH_PARAMS(P)                                                                      \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "distance up to which occluders count") \
  P(float, max_reach, 0.25f, 0, 1, "image widths", "cap on the radius on the screen")        \
  P(choice, outside, border, (border, open),                                                 \
    "what lies beyond the border of the image: the surface at the border, or no occluder")   \
  P(bool, jitter, on, "turn and shift the samples from pixel to pixel")

// Parameters of every technique that uses stochastic depths behind the depth (Vermeer, Scandolo, Eisemann 2021).
#define STOCHASTIC_PARAMS(P)                                                                                       \
  P(int, samples, 4, 1, 16, "", "stochastic depths per pixel")                                                     \
  P(choice, early_out, below, (off, below, on),                                                                    \
    "where hidden depths are skipped: off: nowhere; where the depth lies below the surface, as what is behind it " \
    "lies "                                                                                                        \
    "lower still; on: also where it is within reach, as in the paper")                                             \
  P(float, compensation, 1, 0, 8, "", "factor on the occlusion by hidden depths, which miss some surfaces")

PARAMS(StochasticParams, STOCHASTIC_PARAMS)

#ifdef __OPENCL_C_VERSION__
#include "shared/frame/camera.h"
#include "shared/lanes/pixel_list.h"
#include "shared/lanes/wanted.h"
#include "shared/sampling/layers.h"
#include "shared/sampling/sample.h"

// The points of the pixels that a work-item computes: a row of the image, or with LISTED any (pixel_list.h).
typedef struct {
  integer x, y;
  int here;
  integer own;  // index of each pixel from `here`
  real depth;
  real3 normal;
  Anchor point;
  Reach reach;
  real farthest;          // depth beyond which nothing is within the radius; 0 on background
  real clear_x, clear_y;  // least_distance
  mask climbs;            // asks_behind
  Noise noise;
} Receiver;

// Bounds on layers behind the first, known before they are read.
static inline void expect_behind(Receiver* r, Frame f, scalar radius) {
  r->farthest = choose(r->point.background, (real)(0), r->depth + radius);
  const scalar x = max(fabs(f.centre_x), fabs(f.width - f.centre_x)) * f.scale_x * f.perspective;
  const scalar y = max(fabs(f.centre_y), fabs(f.height - f.centre_y)) * f.scale_y * f.perspective;
  const scalar least = (scalar)0.7 / sqrt(1 + x * x + y * y);
  r->clear_x = r->point.across_x * least;
  r->clear_y = r->point.across_y * least;
  // The most height over the tangent plane that the ray through a pixel within reach gains per unit of depth. `stretch` bounds how much
  // longer than the reach slices are on the screen.
  const Anchor a = r->point;
  const real3 n = r->normal;
  const real stretch = (scalar)f.perspective * (1 + fabs(a.ray_x) + fabs(a.ray_y));
  const real spread =
      fabs(n.x) * a.across_x * (r->reach.pixels_x + 1) + fabs(n.y) * a.across_y * (r->reach.pixels_y + 1);
  r->climbs = n.x * a.ray_x + n.y * a.ray_y - n.z + stretch * spread > 0;
}

// Where layers behind the first are read, as asks_further. A depth behind one below the surface lies lower still, but for surfaces
// so nearly edge-on that rays through pixels within the reach climb away from them: there all are read.
static inline mask asks_behind(Receiver r, mask rises, mask nearer, mask out_of_reach) {
#if EARLY_OUT == 1
  return r.climbs | asks_further(rises, nearer, out_of_reach);
#else
  return asks_further(rises, nearer, out_of_reach);
#endif
}

// Lower bound on the distance from the pixel's point to the ray through a pixel dx to the right and dy below, in units of the
// pixel's depth: rays are no steeper than in the corners of the image.
static inline real least_distance(Receiver r, real dx, real dy) { return fabs(dx) * r.clear_x + fabs(dy) * r.clear_y; }

// From the pixel's point to the point at this depth (dx, dy) pixels away, in units of the pixel's depth.
static inline real3 towards_depth(Frame f, Receiver r, real dx, real dy, real depth) {
  return towards_near(f, r.point, dx, dy, relative_depth(r.point, r.depth, depth));
}

// A point that a view shows, or would show, at column x and row y, not rounded. The caller sets the members that are left.
static inline Receiver receiver_of(Frame frame, scalar radius, scalar max_reach, real x, real y, real depth,
                                   real3 normal) {
  Receiver r;
  r.depth = depth;
  r.normal = normal;
  r.point = anchor_at(frame, x, y, depth);
  r.reach = reach_of(frame, r.point, radius, max_reach * (scalar)frame.width);
  expect_behind(&r, frame, radius);
  return r;
}

#ifndef LISTED
#define LISTED 0
#endif

static inline void set_pixels(Receiver* r, Frame frame, integer x, integer y, int here, integer own) {
  r->x = x;
  r->y = y;
  r->here = here;
  r->own = own;
  r->noise = noise_at(x, y, frame.seed);
}

// The receivers of a row.
static inline Receiver receiver_at(Frame frame, scalar radius, scalar max_reach, PLANE depth, PLANE normal_x,
                                   PLANE normal_y, PLANE normal_z) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  const integer x = FIRST_X + IOTA;
  mask by_both;
  Receiver r = receiver_of(frame, radius, max_reach, to_real(x), (real)(y), depth_seen(load(depth, here), &by_both),
                           load3(normal_x, normal_y, normal_z, here));
  set_pixels(&r, frame, x, (integer)(y), here, IOTA);
  // The row below, which comes after the rest of this one: a CPU's own prefetching does not foresee the step down.
  expect_surface(depth, normal_x, normal_y, normal_z, here + frame.pitch);
  return r;
}

// Receivers at one pixel per lane, by its index from the plane's start.
static inline Receiver receiver_at_index(Frame frame, scalar radius, scalar max_reach, integer index, PLANE depth,
                                         PLANE normal_x, PLANE normal_y, PLANE normal_z) {
  const integer x = column_of(frame, index), y = row_of(frame, index);
  mask by_both;
  Receiver r = receiver_of(frame, radius, max_reach, to_real(x), to_real(y), depth_seen(gather(depth, index), &by_both),
                           gather3(normal_x, normal_y, normal_z, index));
  set_pixels(&r, frame, x, y, 0, index);
  return r;
}

// Reads and writes a plane at the receivers' own pixels.
static inline real read_at(Receiver r, PLANE plane) {
#if LISTED
  return gather(plane, r.own);
#else
  return load(plane, r.here);
#endif
}

static inline void write_at(Receiver r, real value, PLANE_OUT plane) {
#if LISTED
  scatter(value, plane, r.own);
#else
  store(value, plane, r.here);
#endif
}

// RESULT = CALL, with `within` set to what holds for all samples up to `widest` (sample.h).
#define LOOK_AROUND(RESULT, frame, receiver, widest, CALL)           \
  if (is_wide(frame)) {                                              \
    const int within = SAMPLES_IN_WIDE_FRAME;                        \
    RESULT = CALL;                                                   \
  } else if (reaches_only_inside(frame, (receiver).point, widest)) { \
    const int within = SAMPLES_INSIDE;                               \
    RESULT = CALL;                                                   \
  } else {                                                           \
    const int within = SAMPLES_CLAMPED;                              \
    RESULT = CALL;                                                   \
  }

// Treats unwanted pixels as background: open, and without directions.
static inline void leave_out(Receiver* r, mask is_wanted) { r->point.background |= !is_wanted; }

// Stores AO: clamped to 0 to 1, and 1 on background.
static inline void store_open(real open, Receiver r, PLANE_OUT ao) {
  const real kept = smaller(larger(open, (real)(0)), (real)(1));
  write_at(r, choose(r.point.background, (real)(1), kept), ao);
}

// Of kernels that make AO beside something else, for those that ask for it (WITH_AO_RAW).
#if WITH_AO_RAW
#define STORE_AO_RAW(open, r) store_open(open, r, ao_raw);
#define STORE_NO_AO_RAW store((real)(1), ao_raw, here);
#else
#define STORE_AO_RAW(open, r)
#define STORE_NO_AO_RAW
#endif

#endif
#endif
