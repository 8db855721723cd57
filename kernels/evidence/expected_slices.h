// The search of a pixel's slices for evidence of what closes them, and the closed share that it makes expected (evidence.cl). With
// ENVIRONMENT_SIZE also the light of an environment that is missing from what is closed (missing_light.h).
#ifndef GLOAM_EXPECTED_SLICES_H
#define GLOAM_EXPECTED_SLICES_H

#include "estimators/arc.h"
#include "estimators/bent_normal.h"
#include "estimators/extent.h"
#include "estimators/sectors.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/filter/isolated.h"
#include "shared/sampling/slice_steps.h"

#ifdef ENVIRONMENT_SIZE
#include "shared/rays/environment.h"
#define MISSING_LIGHT (!BY_BENT_NORMAL && !BY_NORMAL)
#else
#define MISSING_LIGHT 0
#endif
#if STOCHASTIC
#include "shared/sampling/hidden_depths.h"
#endif

#ifndef WITH_BACK_DEPTH
#define WITH_BACK_DEPTH 0
#endif

// Pixels that no filter averages get EDGE_FACTOR times as many slices: the pass over the image lists them, and another one computes
// them anew. (In the pass over the image, all lanes or a whole warp would wait for one such pixel.)
#if LISTED
#define ROUNDS EDGE_FACTOR
#else
#define ROUNDS 1
#endif
#define TABLE_PARAMETERS TABLE coefficients,
#define TABLES coefficients,

// What is the same for all slices of a row of pixels.
typedef struct {
  Receiver receiver;
  Surface surface;
  real radius, radius_square;  // units of the pixel's depth
  global const float* back;    // WITH_BACK_DEPTH
#ifdef ENVIRONMENT_SIZE
  global const float* environment;  // shared/rays/environment.h
#endif
} Search;

static inline Search search_of(Params params, Receiver r) {
  Search search;
  search.receiver = r;
  search.surface = surface_at(r.point, r.normal);
  // Capped so that background is out of reach of an infinite radius too.
  search.radius = smaller((scalar)params.radius * r.point.inverse_depth, (real)(1e8f));
  search.radius_square = search.radius * search.radius;
  search.back = 0;
  return search;
}

// A kernel's first line: the work-item's receivers, as `r`. Where STORE_OPEN holds for all of them, or none is left in the list, the
// kernel ends. Without LISTED it lists the pixels that no filter averages.
#if LISTED
#define RECEIVERS(r)                                          \
  integer pixels;                                             \
  if (!pixels_of_item(isolated, frame, &pixels)) return;      \
  const Receiver r = receiver_at_index(frame, params.radius, params.max_reach, pixels, depth, normal_x, normal_y, normal_z);
#else
#if EDGE_FACTOR > 1
#define LIST_ISOLATED(r)                                                                                          \
  if (ANY(!r.point.background))                                                                                   \
    append_pixels(isolated, r.here,                                                                               \
                  is_isolated(frame, FIRST_X, ROW_Y, !r.point.background & to_mask(r.x < frame.width),            \
                              choose(r.point.background, (real)(1), r.depth), r.normal, params.radius, depth,      \
                              normal_x, normal_y, normal_z));
#else
#define LIST_ISOLATED(r)
#endif
#define RECEIVERS(r)                                                                                           \
  SKIP_UNWANTED(frame, STORE_OPEN)                                                                             \
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);       \
  leave_out(&r, is_wanted);                                                                                    \
  LIST_ISOLATED(r)
#endif

// What closes one side of a slice.
typedef struct {
  real lowest;      // twice the cosine of the highest occluder's elevation
  natural covered;  // sectors between front and back of occluders
} Closed;

#define WITH_DEGREES (WITH_OPEN_DIRECTIONS || WITH_LOBE || MISSING_LIGHT)
// Directions below the horizon are closed to one degree and those within a thickness to another, so that the slice is closed as
// expected.
typedef struct {
  real below_horizon, within_thickness, elsewhere;
} Degrees;

// One side of a slice, searched outwards. Lengths in units of the pixel's depth.
typedef struct {
  SliceSample sample;
  real cosine, sine;    // of the normal's lean towards this side
  real slope, above_e;  // slice.h
  real share;           // of the slice's mass
  QuickScale scale;     // all sectors lie on this side
  Run run;
  real unknown, others;    // numbers of samples
  real nearness;           // of what is unknown, summed over its samples
  Closed closed;           // with two eyes: by surfaces that this eye alone sees
  Closed closed_by_depth;  // by the first layer alone (COMPENSATED)
#if WITH_DEGREES
  Degrees degrees;  // to which the slice's directions are closed
#endif
#if STEREO
  Closed closed_for_both;  // by surfaces that both eyes see
#endif
} Side;

static inline Side side_of(Slice slice, Search search, scalar sign) {
  Side s;
  s.cosine = slice.cosine;
  s.sine = sign * slice.sine;
  s.slope = sign * slice.slope;
  s.above_e = slice.above_e;
  s.share = larger(share_of_side(s.cosine, s.sine, slice.mass), (real)(LEAST_QUICK_SHARE));
  s.scale = quick_scale_of(scale_of(s.cosine, s.sine, slice.mass * s.share, search.receiver.noise.shift));
  s.run = run_from_receiver();
  s.unknown = s.others = s.nearness = (real)(0);
  s.closed.lowest = (real)(2);
  s.closed.covered = (natural)(0u);
  s.closed_by_depth = s.closed;
#if STEREO
  s.closed_for_both = s.closed;
#endif
  return s;
}

// Takes an occluder with a thickness, where it `counts`.
static inline __attribute__((always_inline)) void take_occluder(const Side* s, SlicePoint p, real thickness,
                                                                mask counts, Closed* closed) {
  const real twice_cosine = p.along * twice_inverse_sqrt(p.square);
  closed->lowest = choose(counts, smaller(twice_cosine, closed->lowest), closed->lowest);
  const real high = smaller(quick_sectors_below(twice_cosine, s->scale), (real)(MOST_SECTORS));
  const real along = multiply_add(s->sine, thickness, p.along), above = multiply_add(-s->cosine, thickness, p.above);
  const real square = multiply_add(along, along, multiply_add(above, above, (real)(1e-30f)));
  const real back = quick_sectors_below(along * quick_twice_inverse_sqrt(square), s->scale);
  // A back below the tangent closes everything below the front.
  const real low = choose(above > 0, smaller(back, high), (real)(0));
  closed->covered |= sectors_between(low, high) & bits_of(counts);
}

// Rounding alone must not hide anything, whatever the bias.
#define LEAST_SLOPE_OF_UNKNOWN ((scalar)0.01f)

// How near a surface that hides something is, where it `hides`: 1 at the point's side and the radius away from it, and less with the
// square of the distance. What hides at many radii says next to nothing about what it hides.
static inline real nearness_of(Search search, real along, real square, mask hides) {
  const real inside = larger(search.radius - along, (real)(0));
  return choose(hides, search.radius * inside * quick_inverse(square), (real)(0));
}

// A depth that lies behind another by less than this share may be the same surface, rounded in another way.
#define SAME_SURFACE ((scalar)1e-3f)

// Thickness of surfaces behind the first, in radii: their extent is not followed.
#define HIDDEN_THICKNESS ((scalar)0.05f)

// Takes a surface at a side's sample, at relative depth e, where it `counts`.
static inline __attribute__((always_inline)) void take_surface(Frame frame, Search search, const Side* s, real e,
                                                               real thickness, mask counts, Closed* closed) {
  SlicePoint p;
  point_in_slice(frame, s->sample, s->slope, s->above_e, e, &p);
  counts &= (p.above > s->sample.least) & (p.square < search.radius_square);
  if (ANY(counts)) take_occluder(s, p, thickness, counts, closed);
}

// Takes every layer at an index from `here`. `is_shared`: where both eyes see the point (STEREO).
static inline __attribute__((always_inline)) void look(Frame frame, Params params, DepthLayers layers, Search search,
                                                       int here, integer place, mask in_frame, mask is_shared,
                                                       Side* s) {
  const Receiver r = search.receiver;
#if GATHERS_ONLY
  s->closed.lowest = smaller(s->closed.lowest, sum_of_depths(layers, frame, here, place, r.farthest));
#if WITH_BACK_DEPTH
  s->closed.lowest = smaller(s->closed.lowest, gather(search.back + here, place));
#endif
  return;
#endif
  mask by_both;
  real e = any_relative_depth(r.point, r.depth, depth_seen(gather(layers.first + here, place), &by_both));
  extend_run(&s->run, e, s->sample.along, search.radius);
  SlicePoint p;
  point_in_slice(frame, s->sample, s->slope, s->above_e, e, &p);
  const mask rises = in_frame & (p.above > s->sample.least);
  const mask counts = rises & (p.square < search.radius_square);
  mask hides = rises & !counts & (e < 0);
#if !SURE_BIAS
  hides &= p.above > LEAST_SLOPE_OF_UNKNOWN * s->sample.along;
#endif
  if (ANY(hides)) {
    s->unknown = choose(hides, s->unknown + 1, s->unknown);
    s->nearness += nearness_of(search, s->sample.along, p.square, hides);
  }
  s->others = choose(has_left_receiver(&s->run), s->others + 1, s->others);
  const real extent = s->run.extent * s->cosine;
#if STEREO
  by_both &= is_shared;
  const real thickness = thickness_of(extent, search.radius);
  if (ANY(counts & by_both)) take_occluder(s, p, thickness, counts & by_both, &s->closed_for_both);
  if (ANY(counts & !by_both)) take_occluder(s, p, thickness, counts & !by_both, &s->closed);
#elif WITH_BACK_DEPTH
  const real back = relative_depth(r.point, r.depth, gather(search.back + here, place));
  const real wide = thickness_of(extent, search.radius), known = larger(back - e, LEAST_THICKNESS * search.radius);
  // Behind a wide thing there is often another one: known backs alone read .003 more on a temple's columns.
  const real thickness = choose(back < FARTHEST, larger(known, (scalar)0.5 * (known + wide)), wide);
  if (ANY(counts)) take_occluder(s, p, thickness, counts, &s->closed);
#elif LAYERS == 1
  if (ANY(counts)) take_occluder(s, p, thickness_of(extent, search.radius), counts, &s->closed);
#else
  real thickness = thickness_of(extent, search.radius);
#if COMPENSATED
  if (ANY(counts)) take_occluder(s, p, thickness, counts, &s->closed_by_depth);
#endif
  const mask asked = in_frame & asks_behind(r, rises, e < 0, p.square >= search.radius_square);
  mask is_there = in_frame;
  // A surface is taken once the next one is known, at which it ends.
  FOR_DEPTHS_BEHIND(behind, layers, frame, here, place, asked, r.farthest) {
    const real next = choose(behind.counts, relative_depth(r.point, r.depth, behind.next), (real)(FARTHEST));
    const mask is_another = next > e + SAME_SURFACE * (1 + fabs(e));
    take_surface(frame, search, s, e, choose(is_another, smaller(thickness, next - e), thickness), is_there,
                 &s->closed);
    e = next;
    is_there = behind.counts;
    thickness = HIDDEN_THICKNESS * search.radius;
  }
  take_surface(frame, search, s, e, thickness, is_there, &s->closed);
#endif
}

#include "shared/sampling/slice_search.h"

// a, b, u, r, n, c and d of a slice.
typedef struct {
  real below_horizon, within_thickness, unknown, others, nearness;
  real below_beside_unknown, within_beside_unknown;
} Evidence;

static inline Evidence no_evidence(void) {
  Evidence e;
  e.below_horizon = e.within_thickness = e.unknown = e.others = e.nearness = (real)(0);
  e.below_beside_unknown = e.within_beside_unknown = (real)(0);
  return e;
}

// Takes one side: the shares of the mass below the highest occluder and within thicknesses, and numbers of samples.
static inline __attribute__((always_inline)) void take_side(real below, real within, real unknown, real nearness,
                                                            real others, Evidence* evidence) {
  MAY_FUSE
  const scalar per_sample = (scalar)(0.5f / STEPS);
  evidence->below_horizon += below;
  evidence->within_thickness += within;
  if (ANY(unknown > 0)) {
    evidence->unknown += unknown * per_sample;
    evidence->nearness += nearness * per_sample;
    evidence->below_beside_unknown += below * unknown * per_sample;
    evidence->within_beside_unknown += within * unknown * per_sample;
  }
  evidence->others += others * per_sample;
}

static inline real share_below_lowest(Slice slice, const Side* s, real lowest) {
  return share_below_cosine((scalar)0.5 * lowest, s->cosine, s->sine, slice.mass);
}

static inline real share_covered(const Side* s, natural covered) {
  return count_of(covered) * (1 / SECTORS) * s->share;
}

static inline __attribute__((always_inline)) void add_side(Slice slice, const Side* s, Closed closed,
                                                           Evidence* evidence) {
  real below = (real)(0), within = (real)(0);
  if (ANY(closed.lowest < 2)) {
    below = share_below_lowest(slice, s, closed.lowest);
    within = share_covered(s, closed.covered);
  }
  take_side(below, within, s->unknown, s->nearness, s->others, evidence);
}

#define TERMS 13
#define FITTED_TERMS (2 * TERMS + 3)
static inline void terms_of(Evidence e, real facing, real* t) {
  const real a = e.below_horizon, b = e.within_thickness, n = e.nearness;
  t[0] = a;
  t[1] = b;
  t[2] = n;
  t[3] = a * a;
  t[4] = a * b;
  t[5] = b * b;
  t[6] = e.below_beside_unknown;
  t[7] = e.within_beside_unknown;
  t[8] = n * n;
  t[9] = a * facing;
  t[10] = b * facing;
  t[11] = a * a * a;
  t[12] = b * b * b;
}

// Of w, v, e and g.
#define NUMBERS (3 * TERMS + 4)

// Fast: factored, for fewer products.
static inline real sum_of_terms(Evidence e, real facing, constant float* weights) {
#ifdef MATH_FAST
  MAY_FUSE
  const real a = e.below_horizon, b = e.within_thickness, n = e.nearness;
  const real of_a = weights[0] + facing * weights[9] + b * weights[4] + a * (weights[3] + a * weights[11]);
  const real of_b = weights[1] + facing * weights[10] + b * (weights[5] + b * weights[12]);
  const real of_n = weights[2] + n * weights[8];
  const real beside = e.below_beside_unknown * weights[6] + e.within_beside_unknown * weights[7];
  return n * of_n + beside + b * of_b + a * of_a;
#else
  real t[TERMS], sum = (real)(0);
  terms_of(e, facing, t);
#pragma unroll
  for (int k = 0; k < TERMS; ++k) sum = multiply_add(t[k], (real)(weights[k]), sum);
  return sum;
#endif
}

// Expected closed share of a slice. Most rows of pixels lie on open surfaces, and show nothing of all this.
static inline __attribute__((always_inline)) real closed_share(Evidence e, real facing, TABLE coefficients) {
  real closed = (real)(0);
  if (ANY((e.below_horizon > 0) | (e.unknown > 0))) {
    closed = sum_of_terms(e, facing, coefficients);
    if (ANY(e.others > 0)) closed = multiply_add(e.others, sum_of_terms(e, facing, coefficients + TERMS), closed);
  }
  return closed;
}

#define WITH_OUTSIDE (WITH_AO_ERROR || TERMS_ONLY)
#if WITH_OUTSIDE
// How far the image goes on from a point in a direction, in reaches of `x` pixels to the right and `y` down.
static inline real reaches_inside(Frame frame, Anchor point, real x, real y) {
  const real columns = choose(x > 0, (scalar)frame.width - (scalar)0.5 - point.x, point.x + (scalar)0.5);
  const real rows = choose(y > 0, (scalar)frame.height - (scalar)0.5 - point.y, point.y + (scalar)0.5);
  const real least = (real)(1e-6f);
  return smaller(columns / larger(fabs(x), least), rows / larger(fabs(y), least));
}

// Share of a slice's samples that lie outside of the image, both sides together.
static inline real share_outside(Frame frame, Receiver r, Slice slice, int within) {
  real outside = (real)(0);
  if (within == SAMPLES_INSIDE) return outside;
  const real x = slice.screen_x * r.reach.pixels_x, y = slice.screen_y * r.reach.pixels_y;
  const real right = reaches_inside(frame, r.point, x, y), left = reaches_inside(frame, r.point, -x, -y);
  for (int k = 0; k < STEPS; ++k) {
    const real t = distance_of_step(k, r.noise);
    outside += choose(t > right, (real)(1), (real)(0)) + choose(t > left, (real)(1), (real)(0));
  }
  return outside * (scalar)(0.5f / STEPS);
}

static inline real error_of_outside(real outside, TABLE coefficients) {
  return outside * outside * coefficients[NUMBERS - 1];
}
#endif

// Without the constant, and without what lies outside.
static inline real expected_error(Evidence e, real facing, TABLE coefficients) {
  constant float* weights = coefficients + 2 * TERMS;
  const real roots = sqrt(larger(e.below_horizon, (real)(0))) * weights[TERMS] + sqrt(e.unknown) * weights[TERMS + 1];
  return roots + sum_of_terms(e, facing, weights);
}

#if WITH_DEGREES
static inline Degrees degrees_of(Evidence e, real closed) {
  const real a = smaller(e.below_horizon, (real)(1)), b = smaller(e.within_thickness, a);
  const real all = smaller(larger(closed, (real)(0)), (real)(1)), least = (real)(1e-6f);
  Degrees d;
  d.within_thickness = smaller(all / larger(b, least), (real)(1));
  d.below_horizon = smaller(larger(all - b, (real)(0)) / larger(a - b, least), (real)(1));
  d.elsewhere = larger(all - a, (real)(0)) / larger(1 - a, least);
  return d;
}

static inline real closed_towards(const Side* s, real along, real up) {
  const real sectors = larger(quick_sectors_below(2 * along, s->scale), (real)(0));
  const natural sector = to_natural(to_integer(smaller(sectors, (real)(MOST_SECTORS))));
  const mask is_within = to_mask(((s->closed.covered >> sector) & 1u) != 0u);
  return choose(is_within, s->degrees.within_thickness,
                choose(2 * along > s->closed.lowest, s->degrees.below_horizon, s->degrees.elsewhere));
}
#include "shared/sampling/slice_directions.h"
#endif
#if MISSING_LIGHT
#include "evidence/missing_light.h"
#endif

// What the slices of a row of pixels sum up to.
typedef struct {
  real closed, error;
#if TERMS_ONLY
  real terms[FITTED_TERMS];
#endif
#if COMPENSATED
  real closed_by_depth;
#endif
#if MISSING_LIGHT
  real3 missing;  // light of the environment that closed directions would send
#endif
} Sum;

static inline Sum no_sum(void) {
  Sum sum;
  sum.closed = sum.error = (real)(0);
#if TERMS_ONLY
  for (int k = 0; k < FITTED_TERMS; ++k) sum.terms[k] = (real)(0);
#endif
#if COMPENSATED
  sum.closed_by_depth = (real)(0);
#endif
#if MISSING_LIGHT
  sum.missing = make3((real)(0), (real)(0), (real)(0));
#endif
  return sum;
}

// One slice. `weight`: of its share in the mean.
static inline __attribute__((always_inline)) void add_slice(Frame frame, Params params, DepthLayers layers,
                                                            Search search, TABLE coefficients, real turn, int within,
                                                            real weight, Sum* sum, OpenDirections* directions) {
  MAY_FUSE
  real cosine, sine;
  const real density = weight * draw_slice(search.receiver.point, search.surface, turn, &cosine, &sine);
  const Slice slice = slice_at(search.receiver.point, search.surface, cosine, sine);
  Side right = side_of(slice, search, (scalar)1), left = side_of(slice, search, (scalar)-1);
  search_slice(frame, params, layers, search, slice, within, &right, &left);
  Evidence evidence = no_evidence();
  add_side(slice, &right, right.closed, &evidence);
  add_side(slice, &left, left.closed, &evidence);
  const real importance = density * slice.weight, facing = search.surface.facing;
  const real closed = closed_share(evidence, facing, coefficients);
  sum->closed += importance * closed;
#if WITH_OUTSIDE
  const real outside = share_outside(frame, search.receiver, slice, within);
#endif
#if TERMS_ONLY
  real t[TERMS];
  terms_of(evidence, facing, t);
  for (int k = 0; k < TERMS; ++k) {
    sum->terms[k] += importance * t[k];
    sum->terms[TERMS + k] += importance * evidence.others * t[k];
  }
  sum->terms[2 * TERMS] += importance * sqrt(larger(evidence.below_horizon, (real)(0)));
  sum->terms[2 * TERMS + 1] += importance * sqrt(evidence.unknown);
  sum->terms[2 * TERMS + 2] += importance * outside * outside;
#endif
#if COMPENSATED
  Evidence by_depth = no_evidence();
  add_side(slice, &right, right.closed_by_depth, &by_depth);
  add_side(slice, &left, left.closed_by_depth, &by_depth);
  sum->closed_by_depth += importance * closed_share(by_depth, facing, coefficients);
#endif
#if WITH_AO_ERROR
  sum->error += importance * (expected_error(evidence, facing, coefficients) + error_of_outside(outside, coefficients));
#endif
#if WITH_DEGREES
  right.degrees = left.degrees = degrees_of(evidence, closed);
#endif
#if MISSING_LIGHT
  add_missing_light(&sum->missing, importance * closed, search, slice, turn, &right, &left);
#endif
#if WITH_OPEN_DIRECTIONS
  take_closed_side(directions, search.surface, slice, density * DIRECTIONS, &right, (scalar)1);
  take_closed_side(directions, search.surface, slice, density * DIRECTIONS, &left, (scalar)-1);
#endif
#if WITH_LOBE
  take_lobe(directions, search.surface, slice, density * DIRECTIONS, &right, &left);
#endif
}

// The mean over ROUNDS times DIRECTIONS slices. Returns the closed share.
static inline __attribute__((always_inline)) real mean_of_slices(Frame frame, Params params, DepthLayers layers,
                                                                 Search search, TABLE coefficients, int within,
                                                                 Sum* sum, OpenDirections* directions) {
  const Noise noise = search.receiver.noise;
  for (int k = 0; k < ROUNDS; ++k) {
    // Slices of further rounds lie between those of the first, and so do their samples.
    const scalar between = (scalar)k * (scalar)(1.0f / EDGE_FACTOR);
    const real shift = noise.shift + between, turn = noise.turn + between;
    search.receiver.noise.shift = choose(shift >= 1, shift - 1, shift);
    const real first = choose(turn >= 1, turn - 1, turn);
    for (int d = 0; d < DIRECTIONS; ++d)
      add_slice(frame, params, layers, search, coefficients, (scalar)d + first, within,
                (real)((scalar)1 / (ROUNDS * DIRECTIONS)), sum, directions);
  }
  return sum->closed;
}

// All slices of pixels that are not background alone.
static inline __attribute__((always_inline)) void search_around(Frame frame, Params params, DepthLayers layers,
                                                                Search search, TABLE coefficients, Sum* sum,
                                                                OpenDirections* directions) {
  const Receiver r = search.receiver;
  // A slice that is not parallel to the image plane reaches further on the screen than the radius at the pixel's depth.
  const Reach widest = longer(r.reach, search.surface.length);
  LOOK_AROUND(sum->closed, frame, r, widest,
              mean_of_slices(frame, params, layers, search, coefficients, within, sum, directions))
}

#endif
