// Gaussian filter of raw AO that ignores edges, along rows and then along columns. Background and pixels beyond the border
// have no weight. The sums of values and of weights are both passed on, so that the result is that of the two-dimensional
// filter everywhere (normalised convolution: Knutsson, Westin 1993).
//
// gaussian_horizontal
// in : source  to be filtered      depth  +inf = background
// out: sum, weight  of the taps in the row
// gaussian_vertical
// in : sum, weight      depth
// out: result  filtered; 1 on background and where it is not wanted
// -D HALF_WIDTH, MASKED (wanted.h)
#include "shared/frame/camera.h"
#include "shared/lanes/wanted.h"

// exp(-x) for x >= 0, relative error below 3e-7. Additions and multiplications only: the same bits on every device.
static inline scalar exp_of_minus(scalar x) {
  // exp(-x) = 2^-n exp(-r) with |r| <= ln(2) / 2; ln(2) in two parts, the first of which has few bits.
  const scalar n = floor(x * (scalar)1.4426950408889634 + (scalar)0.5);
  if (n > 120) return 0;
  const scalar r = (x - n * (scalar)0.693359375) + n * (scalar)2.12194440054690583e-4;
  const scalar series =
      1 - r * (1 - r * ((scalar)(1.0 / 2) -
                        r * ((scalar)(1.0 / 6) -
                             r * ((scalar)(1.0 / 24) -
                                  r * ((scalar)(1.0 / 120) - r * ((scalar)(1.0 / 720) - r * (scalar)(1.0 / 5040)))))));
  return ldexp(series, -(int)n);
}

// 1 at the pixel itself; 0 elsewhere if sigma is below a hundredth of a pixel.
static inline scalar weight_of(int k, scalar sigma) {
  const scalar narrow = (scalar)0.01f, t = (scalar)k / (sigma > narrow ? sigma : narrow);
  return exp_of_minus((scalar)0.5 * t * t);
}

// The weights of a pixel and of those to one side of it, the nearest first.
static inline void weights_of(Params params, scalar* weights) {
#pragma unroll
  for (int k = 0; k <= HALF_WIDTH; ++k) weights[k] = weight_of(k, params.sigma);
}

// in : source, depth; wanted
// out: sum, weight
kernel void gaussian_horizontal(ARGUMENTS) {
  SKIP_UNWANTED(frame, )
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const integer x = FIRST_X + IOTA;
  scalar of_taps[HALF_WIDTH + 1];
  weights_of(params, of_taps);
  real values = 0, weights = 0;
#pragma unroll
  for (int k = -HALF_WIDTH; k <= HALF_WIDTH; ++k) {
    const mask inside = to_mask(to_natural(x + k) < (natural)((uint)frame.width));
    const mask counts = inside & !is_background(load(depth, here + k));
    // Chosen before the multiplication: memory beside the image may hold anything.
    const real value = choose(counts, load(source, here + k), (real)(0));
    const scalar w = of_taps[abs(k)];
    values = multiply_add((real)(w), value, values);
    weights += choose(counts, (real)(w), (real)(0));
  }
  store(values, sum, here);
  store(weights, weight, here);
}

// in : sum, weight, depth; wanted
// out: result
kernel void gaussian_vertical(ARGUMENTS) {
  const int y = ROW_Y, here = index_of(frame, FIRST_X, y);
  SKIP_UNWANTED(frame, store((real)(1), result, here))
  const mask background = is_background(load(depth, here));
  scalar of_taps[HALF_WIDTH + 1];
  weights_of(params, of_taps);
  real values = 0, weights = 0;
#pragma unroll
  for (int k = -HALF_WIDTH; k <= HALF_WIDTH; ++k) {
    if (y + k < 0 || y + k >= frame.height) continue;
    const int there = here + k * frame.pitch;
    const scalar w = of_taps[abs(k)];
    values = multiply_add((real)(w), load(sum, there), values);
    weights = multiply_add((real)(w), load(weight, there), weights);
  }
  // The sum is at least 1, the pixel's own weight, unless the pixel is background.
  const real filtered = mean_up_to_one(values, choose(background, (real)(1), weights));
  store(choose(background | !is_wanted, (real)(1), filtered), result, here);
}
