// SSAO: AO = share of the points in a ball that no visible surface stands before (Mittring 2007).
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
// out: ao_raw       1 = open .. 0 = closed, unfiltered; 1 on background
//      bent_normal  unit, view space (WITH_BENT_NORMAL); zero on background
//      cone         cosine of the half angle of the open cone about it (WITH_CONE)
// -D SAMPLES, HEMISPHERE, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT, COMPENSATED
#include "estimators/ball.h"
#include "estimators/bent_normal.h"
#include "shared/sampling/ball.h"
#include "shared/sampling/ambient_occlusion.h"

#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif

// What is the same for all samples of a row of pixels.
typedef struct {
  Receiver receiver;
  Surface surface;
  Ball ball;
  BallOnScreen on_screen;
  Heights heights;
  real per_range;
  scalar bias;
} Search;

static inline Search search_of(Frame frame, Params params, Receiver r) {
  Search s;
  s.receiver = r;
  s.surface = surface_at(r.point, r.normal);
  const real3 n = normal_towards_eye(s.surface, r.normal), axis = scale3(n, (scalar)1 / sqrt(dot3(n, n)));
  s.ball = ball_of(axis, params.inner, r.noise);
  s.on_screen = ball_on_screen(frame, r.point, r.reach, s.ball.axes);
  s.heights = heights_of(r.point, s.surface, axis, s.on_screen.pixels_x);
  s.per_range = per_range_of(params.range, s.on_screen.radius);
  s.bias = HEMISPHERE ? params.bias : 0;
  return s;
}

// Occlusion of a point, 0 to 1, by the layer at its pixel that occludes most.
static inline __attribute__((always_inline)) real occlusion_at(Frame frame, Params params, DepthLayers layers, Search s,
                                                               integer dx, integer dy, real height, int within) {
  const Receiver r = s.receiver;
  const real there = height_there(s.heights, to_real(dx), to_real(dy)), fall = fall_there(frame, s.heights, there);
  const integer place = index_within(frame, within, dx, dy);
#if GATHERS_ONLY
  return sum_of_depths(layers, frame, r.here, place, r.farthest);
#endif
  const real e = relative_depth(r.point, r.depth, gather(layers.first + r.here, place));
  const mask is_behind = stands_before(e, fall, there - height);
  const real by_first = choose(is_behind, range_weight(e, s.per_range), (real)(0));
  // An occluder within the range occludes the point fully, one in the outer range by a part.
  const mask asked = asks_further(is_behind & (by_first < 1), is_behind, by_first <= 0);
  real largest = by_first;
  FOR_DEPTHS_BEHIND(behind, layers, frame, r.here, place, asked, r.farthest) {
    const real further = relative_depth(r.point, r.depth, behind.next);
    const mask occludes = behind.counts & stands_before(further, fall, there - height);
    largest = larger(choose(occludes, range_weight(further, s.per_range), (real)(0)), largest);
  }
  return COMPENSATE(params, largest, by_first);
}

static inline __attribute__((always_inline)) real occluded_points(Frame frame, Params params, DepthLayers layers,
                                                                  Search s, int within, OpenDirections* open) {
  const Receiver r = s.receiver;
  real sum = 0;
// Unrolled, it is no faster and takes far longer to compile.
#pragma unroll 1
  for (int k = 0; k < SAMPLES; ++k) {
    const BallPoint point = next_point(&s.ball, k);
    integer dx, dy;
    project(s.on_screen, point, &dx, &dy);
    const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
    const real height = point.distance * ((point.axis + s.bias) * s.on_screen.radius) + s.heights.rounding;
    const real found = counted(counts, occlusion_at(frame, params, layers, s, dx, dy, height, within));
    sum += found;
#if WITH_OPEN_DIRECTIONS
    add_open(open, direction_of(point, s.ball.axes), 1 - found);
#endif
  }
  return sum;
}

// in : depth, normal; occluders, wanted
// out: ao_raw; bent_normal, cone
kernel void ssao_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here); STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections open = no_directions();
  real occluded = 0;
  if (ANY(!r.point.background)) {
    const Search s = search_of(frame, params, r);
    const Reach widest = reach_of_ball(s.on_screen, s.surface);
    LOOK_AROUND(occluded, frame, r, widest, occluded_points(frame, params, layers, s, within, &open))
  }
  store_open(1 - occluded * ((scalar)1 / SAMPLES), r, ao_raw);
  STORE_OPEN_DIRECTIONS(open, r)
}
