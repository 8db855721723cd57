// The cost of HBAO+'s sampling alone: the addresses of kernels/hbao_plus, one gather each, and a sum. Compiled after
// shared/sampling/fan.h. -D LANES, DIRECTIONS, STEPS, JITTER
static inline __attribute__((always_inline)) real sum_of_gathers(Frame frame, global const float* depth, Receiver r,
                                                                 Fan fan, int within) {
  real sum = 0;
  for (int d = 0; d < DIRECTIONS; ++d) {
#pragma unroll
    for (int k = 0; k < STEPS; ++k) {
      integer dx, dy;
      step_at(fan, k, &dx, &dy);
      keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
      sum += sample_near(depth, frame, r.here, within, dx, dy);
    }
    turn(&fan);
  }
  return sum;
}

kernel void gather_floor(Frame frame, float radius, float max_reach, PLANE depth, PLANE_OUT result) {
  // The depth stands in for the normal, which is unused.
  const Receiver r = receiver_at(frame, radius, max_reach, depth, depth, depth, depth);
  if (!ANY(!r.point.background)) {
    store((real)(0), result, r.here);
    return;
  }
  const Fan fan = fan_of(r.reach, r.noise);
  real sum;
  LOOK_AROUND(sum, frame, r, r.reach, sum_of_gathers(frame, depth, r, fan, within))
  store(sum, result, r.here);
}
