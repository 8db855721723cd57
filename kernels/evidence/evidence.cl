// Ambient occlusion expected from evidence: what slices (Jimenez, Wu, Pesce, Jarabo 2016) show of occluders is combined into the
// expected closed share, by a polynomial with coefficients that are fitted to ray-traced truth (coefficients.json).
//
// Of each slice, both sides together:
//   a  share of the mass below the highest occluder: occluders have no back (estimators/arc.h)
//   b  share of the mass between front and back of occluders that are as thick as they are wide (estimators/extent.h), by
//      sectors (estimators/sectors.h; Therrien, Levesque, Gilet 2023); where layers or a back tell the thickness, the known one
//   u  share of the samples above the tangent, out of reach and nearer to the eye than the point: what they hide is unknown
//   r  share of the samples that lie beyond a jump of the depth, on another surface than the point
//   f  cosine between the normal and the line to the eye
//   n  how near that is: mean over the samples of (1 - l / R) R^2 / d^2 where they count for u and of 0 elsewhere, l the distance along
//      the tangent, d that of what is seen, R the radius
//   c, d  a and b of each side times its share of u, summed over the sides
//   t = (a, b, n, aa, ab, bb, c, d, nn, af, bf, aaa, bbb)
//   AO = 1 - mean over slices of (w + r v) . t
// w holds where one surface fills the surroundings, w + v among leaves and hair. There is no constant term: a plane is open to the
// last bit. The expected absolute error of AO is e . (t, sqrt(a), sqrt(u), 1) + g oo, where
//   o  share of the samples that lie outside of the image: what occludes there is unknown
//
// in : depth         view-space z, scene units, +inf = background
//      normal        unit, view space
//      occluders     further depth layers (layers.h); without them, depth is the only layer
//      back_depth    of the back of what is seen, +inf where it is unknown (WITH_BACK_DEPTH)
//      other_depth   of the other eye (shared/stereo/slices.h)
//      coefficients  w, v, e, g; then those for a known back
// out: ao_raw        1 = open .. 0 = closed, unfiltered; 1 on background
//      ao_error_raw  expected absolute error of the filtered AO, unfiltered (WITH_AO_ERROR); 0 on background
//      bent_normal   unit, view space (WITH_BENT_NORMAL); zero on background
//      cone          cosine of the half angle of the open cone about it (WITH_CONE)
// -D DIRECTIONS, STEPS, EDGE_FACTOR, SURE_BIAS (the bias is at least LEAST_SLOPE_OF_UNKNOWN), TERMS_ONLY (for fitting: the terms as
//    planes), JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT, COMPENSATED, STEREO, ESTIMATE_MONO,
//    WITH_HALF_OCCLUSION
#include "evidence/expected_slices.h"
#include "shared/lanes/components.h"

#ifdef COLUMNS
#if !STEREO
// Of the expected error.
#define FILTER_DISTANCE (ISOLATED_DISTANCE * params.radius)
#define FILTER_ANGLE ISOLATED_ANGLE
#define FILTER_OUTSIDE ((real)(0))
#endif
#include "shared/filter/bilateral_filter.h"
#endif

#if WITH_AO_ERROR
#define STORE_NO_ERROR store((real)(0), ao_error, here);
#else
#define STORE_NO_ERROR
#endif

#if TERMS_ONLY
// A plane each: t, r t, the roots of a and u, and oo.
#define FOR_TERMS(DO)                                                                                                \
  DO(0)                                                                                                              \
  DO(1)                                                                                                              \
  DO(2)                                                                                                              \
  DO(3)                                                                                                              \
  DO(4)                                                                                                              \
  DO(5)                                                                                                              \
  DO(6) DO(7) DO(8) DO(9) DO(10) DO(11) DO(12) DO(13) DO(14) DO(15) DO(16) DO(17) DO(18) DO(19) DO(20) DO(21) DO(22) \
      DO(23) DO(24) DO(25) DO(26) DO(27) DO(28)
#define STORE_TERM(k) write_at(r, choose(r.point.background, (real)(0), mean.terms[k]), term_##k);
#define STORE_OPEN
#else
#define STORE_OPEN                \
  store((real)(1), ao_raw, here); \
  STORE_NO_ERROR STORE_NO_DIRECTIONS
#endif

// in : coefficients, depth, normal; occluders, roughness, wanted, back_depth, isolated
// out: ao_raw; isolated, bent_normal, cone, specular_occlusion_raw, lobe_weight, ao_error
kernel void evidence_estimate(ARGUMENTS) {
  RECEIVERS(r)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  OpenDirections directions = whole_hemisphere(r.normal);
  SET_LOBE(directions, r)
  Sum mean = no_sum();
  coefficients += WITH_BACK_DEPTH * NUMBERS;
  if (ANY(!r.point.background)) {
    Search search = search_of(params, r);
#if WITH_BACK_DEPTH
    search.back = back_depth;
#endif
    search_around(frame, params, layers, search, coefficients, &mean, &directions);
  }
#if TERMS_ONLY
  FOR_TERMS(STORE_TERM)
  return;
#else
  store_open(1 - COMPENSATE(params, mean.closed, mean.closed_by_depth), r, ao_raw);
#if WITH_AO_ERROR
  // Of what no slice shows, the same everywhere.
  const real error = mean.error + coefficients[3 * TERMS + 2];
  write_at(r, choose(r.point.background, (real)(0), smaller(larger(error, (real)(0)), (real)(1))), ao_error);
#endif
  STORE_OPEN_DIRECTIONS(directions, r)
#endif
}

#if STEREO
#include "shared/stereo/slice_view.h"

// The mean of both eyes; what the own eye finds where the other does not see the point.
static inline real of_both(real own, real other, mask is_seen) {
  return choose(is_seen, (scalar)0.5 * (own + other), own);
}

// A surface that both eyes see counts by the mean of what each eye's slice holds; one that one eye alone sees counts for both, as in
// the eye that it closes more of.
static inline void add_side_of_both(const View* own, const View* other, const Side* s, const Side* o, mask is_seen,
                                    Evidence* evidence) {
  const real alone = larger(share_below_lowest(own->slice, s, s->closed.lowest),
                            choose(is_seen, share_below_lowest(other->slice, o, o->closed.lowest), (real)(0)));
  const real below = of_both(larger(share_below_lowest(own->slice, s, s->closed_for_both.lowest), alone),
                             larger(share_below_lowest(other->slice, o, o->closed_for_both.lowest), alone), is_seen);
  const natural covered = s->closed.covered | (o->closed.covered & bits_of(is_seen));
  const real within = of_both(share_covered(s, covered | s->closed_for_both.covered),
                              share_covered(o, covered | o->closed_for_both.covered), is_seen);
  take_side(below, within, of_both(s->unknown, o->unknown, is_seen), of_both(s->nearness, o->nearness, is_seen),
            of_both(s->others, o->others, is_seen), evidence);
}

static inline real closed_to_both(TABLE_PARAMETERS Search here, Search there, const View* own, const View* other,
                                  mask is_seen) {
  Evidence evidence = no_evidence();
  add_side_of_both(own, other, &own->right, &other->right, is_seen, &evidence);
  add_side_of_both(own, other, &own->left, &other->left, is_seen, &evidence);
  const real facing = of_both(here.surface.facing, there.surface.facing, is_seen);
  return of_both(own->importance, other->importance, is_seen) * closed_share(evidence, facing, coefficients);
}

#include "shared/stereo/slices.h"
#endif
