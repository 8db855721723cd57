// Volumetric obscurance: AO = share of the half ball above the surface that lies before what the screen shows (Loos, Sloan 2010,
// line samples). Each sample on a disk is a column of the ball, cut off by the depth there.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
// out: ao_raw     1 = open .. 0 = closed, unfiltered; 1 on background
// -D SAMPLES, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED
#include "estimators/column.h"
#include "shared/sampling/disk.h"
#include "shared/sampling/ambient_occlusion.h"

// What is the same for all samples of a row of pixels.
typedef struct {
  Receiver receiver;
  Disk disk;
  Heights heights;
  real middle_x, middle_y;  // height of a column's middle, per pixel to the right and down
  real rise;                // from the pixel's point to the sphere, along its own column
  real bias;                // height up to which a surface at the radius occludes nothing
  real per_range;
} Search;

static inline Search search_of(Frame frame, Params params, Receiver r, Surface surface) {
  const Anchor a = r.point;
  const real3 n = normal_towards_eye(surface, r.normal), v = surface.to_eye;
  const real facing = dot3(n, v);
  Search s;
  s.receiver = r;
  s.disk = disk_of(frame, a, surface, r.reach, r.noise);
  s.heights = heights_of(a, surface, n, r.reach.pixels_x);
  s.middle_x = a.across_x * (n.x - facing * v.x);
  s.middle_y = -a.across_y * (n.y - facing * v.y);
  s.rise = s.disk.radius * facing;
  s.bias = s.disk.radius * params.bias;
  s.per_range = per_range_of(params.range, s.disk.radius);
  return s;
}

// Length of a column that a surface at this depth occludes.
static inline real occlusion_by(Search s, Column column, real depth, real fall, real counts_from) {
  const real e = relative_depth(s.receiver.point, s.receiver.depth, depth);
  return below(column, surface_height(e, fall, counts_from, s.heights)) * range_weight(e, s.per_range);
}

// Occluded length of a column, by the layer at its pixel that occludes most.
static inline real occlusion_at(Frame frame, DepthLayers layers, Search s, integer dx, integer dy, Column column,
                                real bias, int within) {
  const Receiver r = s.receiver;
  const integer index = index_within(frame, within, dx, dy);
#if GATHERS_ONLY
  return sum_of_depths(layers, frame, r.here, index, r.farthest);
#endif
  const real there = height_there(s.heights, to_real(dx), to_real(dy)), fall = fall_there(frame, s.heights, there);
  const real counts_from = there - bias - s.heights.rounding;
  real largest = larger(occlusion_by(s, column, gather(layers.first + r.here, index), fall, counts_from), (real)(0));
  FOR_DEPTHS_BEHIND(behind, layers, frame, r.here, index, EVERY_LANE, r.farthest) {
    largest = larger(occlusion_by(s, column, behind.next, fall, counts_from), largest);
  }
  return largest;
}

// Occluded share of all columns together.
static inline __attribute__((always_inline)) real occluded_share(Frame frame, DepthLayers layers, Search s,
                                                                 int within) {
  const Receiver r = s.receiver;
  real occluded = 0, whole = 0;
// Unrolled it is no faster, and takes far longer to compile.
#pragma unroll 1
  for (int k = 0; k < SAMPLES; ++k) {
    integer dx, dy;
    real distance, square;
    next_offset(&s.disk, k, &dx, &dy, &distance, &square);
    const real middle = to_real(dx) * s.middle_x + to_real(dy) * s.middle_y;
    const mask counts = keep_in_frame(frame, r.x, r.y, within, &dx, &dy);
    const real left = 1 - square + (scalar)1e-20f;  // above 0
    const Column column = part_above(middle, s.rise * (left * inverse_sqrt(left)));
    const real found = occlusion_at(frame, layers, s, dx, dy, column, distance * s.bias, within);
    occluded += counted(counts, found);
    whole += column.high - column.low;
  }
  return choose(whole > 0, quotient(occluded, whole), (real)(0));
}

// in : depth, normal; occluders, wanted
// out: ao_raw
kernel void volumetric_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  real occluded = 0;
  if (ANY(!r.point.background)) {
    const Surface surface = surface_at(r.point, r.normal);
    const Search s = search_of(frame, params, r, surface);
    // The disk is not parallel to the image plane: it reaches further on the screen.
    const Reach widest = longer(r.reach, surface.length);
    LOOK_AROUND(occluded, frame, r, widest, occluded_share(frame, layers, s, within))
  }
  store_open(1 - occluded, r, ao_raw);
}
