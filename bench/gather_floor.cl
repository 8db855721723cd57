// What HBAO+'s sampling costs by itself: the addresses of kernels/hbao_plus, one gather each, and a sum.
// Comes after shared/sample.h. -D LANES, DIRECTIONS, STEPS
static inline __attribute__((always_inline)) real sum_of_gathers(Frame frame, global const float* depth, integer x,
                                                                 int y, int here, Reach reach, real turn, real shift,
                                                                 int within) {
  const real stride_x = larger(reach.pixels_x - 1, (real)(0)) * (1.0f / STEPS);
  const real stride_y = larger(reach.pixels_y - 1, (real)(0)) * (1.0f / STEPS);
  real cosine, sine, turn_cosine, turn_sine, sum = 0;
  cosine_sine_of_turns(turn, &cosine, &sine);
  cosine_sine_of_turns((real)(1.0f / DIRECTIONS), &turn_cosine, &turn_sine);
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx = nearest(cosine * (1 + (shift + k) * stride_x)), dy = nearest(sine * (1 + (shift + k) * stride_y));
      keep_in_frame(frame, x, y, within, &dx, &dy);
      sum += sample_near(depth, frame, here, within, dx, dy);
    }
    const real next = cosine * turn_cosine - sine * turn_sine;
    sine = sine * turn_cosine + cosine * turn_sine;
    cosine = next;
  }
  return sum;
}

kernel void gather_floor(Frame frame, float radius, int max_pixels, PLANE depth, PLANE_OUT result) {
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);
  const integer x = x0 + IOTA;
  const real z = load(depth, here);
  if (!ANY(!is_background(z))) {
    store((real)(0), result, here);
    return;
  }
  const Anchor point = anchor_at(frame, to_real(x), (real)(y), z);
  const Reach reach = reach_of(point, radius, max_pixels);
  const natural h = pixel_hash(x, y, frame.seed);
  const real turn = unit_random(h) * (1.0f / DIRECTIONS), shift = unit_random(hash(h + 1));
  real sum;
#define SUM_OF_GATHERS(within) sum_of_gathers(frame, depth, x, y, here, reach, turn, shift, within)
  if (frame.pitch >= SHORT_PITCH) {
    sum = SUM_OF_GATHERS(SAMPLES_IN_WIDE_FRAME);
  } else if (reaches_only_inside(frame, point, reach)) {
    sum = SUM_OF_GATHERS(SAMPLES_INSIDE);
  } else {
    sum = SUM_OF_GATHERS(SAMPLES_CLAMPED);
  }
  store(sum, result, here);
}
