// Ambient occlusion expected from evidence: what slices (Jimenez, Wu, Pesce, Jarabo 2016) show of occluders is combined into the
// expected closed share, by a polynomial with coefficients that are fitted to ray-traced truth (coefficients.h).
//
// Of each slice, both sides together:
//   a  share of the mass below the highest occluder: occluders have no back (estimators/arc.h)
//   b  share of the mass between front and back of occluders that are half as thick as they are wide (estimators/extent.h), by
//      sectors (estimators/sectors.h; Therrien, Levesque, Gilet 2023)
//   u  share of the samples above the tangent, out of reach and nearer to the eye than the point: what they hide is unknown
//   f  cosine between the normal and the line to the eye
//   AO = 1 - mean over slices of w . (a, b, u, aa, ab, bb, au, bu, uu, af, bf, uf)
// There is no constant term: a plane is open to the last bit.
//
// in : depth       view-space z, scene units, +inf = background
//      normal      unit, view space
// out: ao_raw      1 = open .. 0 = closed, unfiltered; 1 on background
// -D DIRECTIONS, STEPS, COEFFICIENTS (row of coefficients.h), TERM (one term alone, for fitting), JITTER, OUTSIDE_OPEN, MASKED
#include "estimators/arc.h"
#include "estimators/extent.h"
#include "estimators/sectors.h"
#include "evidence/coefficients.h"
#include "evidence/params.h"
#include "shared/sampling/slice_steps.h"

#define ROW(directions, steps, ...) {__VA_ARGS__},
constant float coefficients[][EVIDENCE_TERMS] = {EVIDENCE_COEFFICIENTS(ROW)};

// What is the same for all slices of a row of pixels.
typedef struct {
  Receiver receiver;
  Surface surface;
  real radius, radius_square;  // units of the pixel's depth
} Search;

static inline Search search_of(Params params, Receiver r) {
  Search search;
  search.receiver = r;
  search.surface = surface_at(r.point, r.normal);
  // Capped so that background is out of reach of an infinite radius too.
  search.radius = smaller((scalar)params.radius * r.point.inverse_depth, (real)(1e8f));
  search.radius_square = search.radius * search.radius;
  return search;
}

#define LEAST_SLOPE_OF_UNKNOWN ((scalar)0.01f)

// Sectors of a side with less of the slice's mass are wider: rounding of the horizon alone would reach one.
#define LEAST_SHARE ((scalar)0.01f)

// One side of a slice, searched outwards. Lengths in units of the pixel's depth.
typedef struct {
  real cosine, sine;      // of the normal's lean towards this side
  real slope, above_e;    // slice.h
  real share;             // of the slice's mass
  Scale scale;            // all sectors lie on this side
  real horizon;           // of all occluders (arc.h)
  real solid_horizon;     // of occluders that reach down to the tangent
  natural covered;        // sectors of the other occluders
  real unknown;           // number of samples
  Run run;
} Side;

static inline Side side_of(Slice slice, Search search, scalar sign) {
  Side s;
  s.cosine = slice.cosine;
  s.sine = sign * slice.sine;
  s.slope = sign * slice.slope;
  s.above_e = slice.above_e;
  s.share = larger(share_of_side(s.cosine, s.sine, slice.mass), (real)(LEAST_SHARE));
  s.scale = scale_of(s.cosine, s.sine, slice.mass * s.share, search.receiver.noise.shift);
  s.horizon = s.solid_horizon = (real)(NO_HORIZON);
  s.covered = (natural)(0u);
  s.unknown = (real)(0);
  s.run = run_from_receiver();
  return s;
}

static inline __attribute__((always_inline)) void take_sample(Frame frame, Search search, SliceSample sample,
                                                              real depth, Side* s) {
#if GATHERS_ONLY
  s->horizon = smaller(s->horizon, depth);
  return;
#endif
  const Receiver r = search.receiver;
  const real e = relative_depth(r.point, r.depth, depth);
  const real extent = extend_run(&s->run, e, sample.along, search.radius) * s->cosine;
  const real thickness = thickness_of(extent, search.radius);
  SlicePoint p;
  point_in_slice(frame, sample, s->slope, s->above_e, e, &p);
  const real along = p.along, above = p.above;
  const mask rises = sample.in_frame & (above > sample.least);
  const mask counts = rises & (p.square < search.radius_square);
  // Rounding alone must not count, whatever the bias.
  const mask hides = rises & !counts & (e < 0) & (above > LEAST_SLOPE_OF_UNKNOWN * sample.along);
  s->unknown += choose(hides, (real)(1), (real)(0));
  s->horizon = raised(s->horizon, along, above, counts);
  // As for the bitmask of gtao: few occluders float above the tangent.
  const real back = above - s->cosine * thickness;
  const mask floats = counts & (back > 0);
  s->solid_horizon = raised(s->solid_horizon, along, above, counts & (back <= 0));
  if (ANY(floats)) {
    const real low = approximate_sectors_below(multiply_add(s->sine, thickness, along), back, s->scale);
    s->covered |= sectors_between(low, approximate_sectors_below(along, above, s->scale)) & bits_of(floats);
  }
}

// a, b and u above.
typedef struct {
  real below_horizon, within_extent, unknown;
} Evidence;

static inline void add_side(Slice slice, const Side* s, Evidence* evidence) {
  const natural covered = s->covered | sectors_between((real)(0), sectors_below_horizon(s->solid_horizon, s->scale));
  evidence->below_horizon += share_below(s->horizon, s->cosine, s->sine, slice.mass);
  evidence->within_extent += count_of(covered) * (1 / SECTORS) * s->share;
  evidence->unknown += s->unknown * (scalar)(0.5f / STEPS);
}

static inline Evidence evidence_of(Frame frame, Params params, DepthLayers layers, Search search, Slice slice, int within) {
  const Receiver r = search.receiver;
  Side right = side_of(slice, search, (scalar)1), left = side_of(slice, search, (scalar)-1);
  for (int k = 0; k < STEPS; ++k) {
    SliceSample there, other;
    samples_of_step(frame, params.bias, r, slice, within, k, &there, &other);
    take_sample(frame, search, there, gather(layers.first + r.here, there.place), &right);
    take_sample(frame, search, other, gather(layers.first + r.here, other.place), &left);
  }
  Evidence evidence;
  evidence.below_horizon = evidence.within_extent = evidence.unknown = (real)(0);
  add_side(slice, &right, &evidence);
  add_side(slice, &left, &evidence);
  return evidence;
}

static inline real term_of(int term, real a, real b, real u, real facing) {
  switch (term) {
    case 0: return a;
    case 1: return b;
    case 2: return u;
    case 3: return a * a;
    case 4: return a * b;
    case 5: return b * b;
    case 6: return a * u;
    case 7: return b * u;
    case 8: return u * u;
    case 9: return a * facing;
    case 10: return b * facing;
    default: return u * facing;
  }
}

// Expected closed share of a slice.
static inline real closed_share(Evidence e, real facing) {
#if TERM
  return term_of(TERM - 1, e.below_horizon, e.within_extent, e.unknown, facing);
#else
  real closed = (real)(0);
#pragma unroll
  for (int k = 0; k < EVIDENCE_TERMS; ++k) {
    const real term = term_of(k, e.below_horizon, e.within_extent, e.unknown, facing);
    closed = multiply_add((real)(coefficients[COEFFICIENTS][k]), term, closed);
  }
  return closed;
#endif
}

static inline __attribute__((always_inline)) real open_share(Frame frame, Params params, DepthLayers layers, Search search,
                                                             int within) {
  const Receiver r = search.receiver;
  real closed = (real)(0);
  for (int d = 0; d < DIRECTIONS; ++d) {
    real cosine, sine;
    const real inverse_density = draw_slice(r.point, search.surface, (scalar)d + r.noise.turn, &cosine, &sine);
    const Slice slice = slice_at(r.point, search.surface, cosine, sine);
    const Evidence evidence = evidence_of(frame, params, layers, search, slice, within);
    closed += inverse_density * slice.weight * closed_share(evidence, search.surface.facing);
  }
  return 1 - closed * (scalar)(1.0f / DIRECTIONS);
}

kernel void evidence_estimate(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                              WANTED_ARGUMENT PLANE_OUT ao_raw) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here))
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  real open = 1;
  if (ANY(!r.point.background)) {
    const Search search = search_of(params, r);
    // A slice that is not parallel to the image plane reaches further on the screen than the radius at the pixel's depth.
    const Reach widest = longer(r.reach, search.surface.length);
    LOOK_AROUND(open, frame, r, widest, open_share(frame, params, layers, search, within))
  }
  store_open(open, r, ao_raw);
}
