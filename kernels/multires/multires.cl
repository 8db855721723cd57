// Ambient occlusion from several resolutions (Hoang, Low 2010 and 2012). Each resolution samples a ring around the pixel that is
// equally wide in its own pixels; together the rings cover the radius. From the coarsest on, a result is brought to the next
// resolution by joint bilateral upsampling, and combined with that one's own.
//
// subsample: shared/filter/subsample.h
//
// estimate: level 0 is the whole image, each further one half as wide and high as the one before.
// in : depth, normal          of this level; view-space z, scene units, +inf = background; unit, view space
//      low_depth, low_normal  of the next coarser level (COARSER)
//      low_most, low_sum      results of the coarser levels (COARSER; the sum WITH_MEAN)
// out: most    largest mean obscurance of any level so far (level 1 and up)
//      sum     of the mean obscurances of all levels so far (level 1 and up, WITH_MEAN)
//      ao_raw  1 = open .. 0 = closed; 1 on background (level 0)
// -D MASKED (wanted.h), LEVEL, LEVELS, COARSER, SAMPLES, WITH_MEAN, JITTER, NO_FALLOFF, OUTSIDE_OPEN, SCALE (2)
#include "estimators/obscurance.h"
#include "shared/filter/subsample.h"
#include "shared/filter/upsample.h"
#include "shared/lanes/wanted.h"
#include "shared/sampling/ambient_occlusion.h"

// in : depth, normal
// out: low_depth, low_normal
kernel void multires_subsample(ARGUMENTS) {
  subsample_surface(frame, other, depth, normal_x, normal_y, normal_z, low_depth, low_normal_x, low_normal_y,
                    low_normal_z);
}

#ifdef LEVEL

// The ring that this level covers, in its own pixels along each axis, ending at the radius. All levels together reach
// `most_pixels`: the coarsest covers the outer half, the next one the outer half of the rest, and so on.
typedef struct {
  real from_x, from_y, to_x, to_y;
  mask is_empty;
  mask goes_on;  // the radius reaches beyond the ring, into coarser levels
} Ring;

#define OUTER ((scalar)1 / (1 << (LEVELS - 1 - LEVEL)))

static inline Ring ring_of(Reach reach, scalar most_pixels) {
  const scalar outer = most_pixels * OUTER;
  Ring r;
#if LEVEL == 0
  r.from_x = r.from_y = (real)(1);
  r.is_empty = !EVERY_LANE;
#else
  r.from_x = r.from_y = (real)((scalar)0.5 * outer);
  r.is_empty = !(reach.pixels_x > r.from_x);
#endif
  r.to_x = larger(smaller(reach.pixels_x, (real)(outer)), r.from_x);
  r.to_y = larger(smaller(reach.pixels_y, (real)(outer)), r.from_y);
  r.goes_on = reach.pixels_x > outer;
  return r;
}

// Samples at even steps from the inner to the outer edge of the ring, the direction turned by the golden angle from sample to
// sample: any run of samples is spread over all directions.
static inline __attribute__((always_inline)) real sum_of_obscurance(Frame frame, Params params,
                                                                    global const float* depth, Receiver r, Ring ring,
                                                                    int within) {
  const scalar turn_cosine = (scalar)-0.7373688780783197, turn_sine = (scalar)0.6754902942615238;
  const real stride_x = (ring.to_x - ring.from_x) * (scalar)(1.0f / SAMPLES);
  const real stride_y = (ring.to_y - ring.from_y) * (scalar)(1.0f / SAMPLES);
  real cosine, sine, sum = 0;
  cosine_sine_of_turns(r.noise.turn, &cosine, &sine);
#pragma unroll 8
  for (int k = 0; k < SAMPLES; ++k) {
    const real along = r.noise.shift + (scalar)k;
    integer dx = nearest(cosine * (ring.from_x + along * stride_x));
    integer dy = nearest(sine * (ring.from_y + along * stride_y));
    const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
    const real sample = sample_near(depth, frame, r.here, within, dx, dy);
#if GATHERS_ONLY
    sum += sample;
#else
    const real3 v = towards_depth(frame, r, to_real(dx), to_real(dy), sample);
    const real found = obscurance(v, r.normal, params.bias, r.reach.inverse_square);
    sum += counted(counts, found);
#endif
    const real next = cosine * turn_cosine - sine * turn_sine;
    sine = sine * turn_cosine + cosine * turn_sine;
    cosine = next;
  }
  return sum;
}

// Number of levels whose rings lie within a reach of this many pixels of level 0.
static inline real levels_within(real pixels, scalar most_pixels) {
  real count = 1;
  for (int level = 1; level < LEVELS; ++level) {
    const scalar from = most_pixels * ((scalar)1 / (1 << (LEVELS - level)));
    count += choose(pixels > from, (real)(1), (real)(0));
  }
  return count;
}

// in : depth, normal; low_most, low_depth, low_normal, low_sum, wanted
// out: ; most_found, ao_raw, sum_found
kernel void multires_estimate(ARGUMENTS) {
#if LEVEL == 0
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
#endif
  const Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  const scalar most_pixels = params.max_reach * (scalar)frame.width;
  const Ring ring = ring_of(r.reach, most_pixels);
  real most = 0, sum = 0;
  if (ANY(!(r.point.background | ring.is_empty))) {
    real here_found;
    LOOK_AROUND(here_found, frame, r, r.reach, sum_of_obscurance(frame, params, depth, r, ring, within))
    most = choose(ring.is_empty, (real)(0), here_found * (params.strength * (scalar)(1.0f / SAMPLES)));
    sum = most;
  }
#if COARSER
  if (ANY(ring.goes_on & !r.point.background)) {
    const Site site = site_at(frame, other, params.depth_tolerance * params.radius, params.normal_tolerance, depth,
                              normal_x, normal_y, normal_z);
    const Weights weights = weights_of(site, frame, low_depth, low_normal_x, low_normal_y, low_normal_z);
    const mask known = ring.goes_on & (weights.total > 0);
    const real share = choose(known, quick_inverse(choose(known, weights.total, (real)(1))), (real)(0));
    most = larger(weighted(weights, site, low_most) * share, most);
#if WITH_MEAN
    sum += weighted(weights, site, low_sum) * share;
#endif
  }
#endif
#if LEVEL == 0
#if WITH_MEAN
  // The maximum and the mean each account for about half of the occlusion.
  const real mean = sum * quick_inverse(levels_within(r.reach.pixels_x, most_pixels));
  const real open = (1 - smaller(most, (real)(1))) * (1 - smaller(mean, (real)(1)));
#else
  const real open = 1 - 2 * most;
#endif
  store_open(choose(is_wanted, open, (real)(1)), r, ao_raw);
#else
  store(choose(r.point.background, (real)(0), most), most_found, r.here);
#if WITH_MEAN
  store(choose(r.point.background, (real)(0), sum), sum_found, r.here);
#endif
#endif
}

#endif
