// Ambient occlusion by slices: GTAO's sampling and integral (Jimenez, Wu, Pesce, Jarabo 2016, sections 4 and 5), where the
// highest occluder closes everything below it; or with BITMASK occluders of one thickness that close what lies between their
// front and back (Therrien, Levesque, Gilet 2023). AO = 1 - mean over slices of the closed share of their cosine-weighted mass;
// slices are drawn in proportion to that mass (slice_angle.h), so that one slice a pixel is the integral over all on average.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      occluders  further depth layers (layers.h); without them, depth is the only layer
//      other_depth  of the other eye (shared/stereo/slices.h)
// out: ao_raw       1 = open .. 0 = closed, unfiltered; 1 on background
//      bent_normal  unit, view space (WITH_BENT_NORMAL); zero on background
//      cone         cosine of the half angle of the open cone about it (WITH_CONE)
//      specular_occlusion_raw  open share of the surface's lobe (WITH_SPECULAR_OCCLUSION_RAW; reads roughness); 1 on background
//      lobe_weight  of the part of the lobe that the slices hold (WITH_LOBE_WEIGHT; reads roughness); 0 on background
// -D DIRECTIONS, STEPS, BITMASK, FADE, THICKNESS_HEURISTIC, JITTER, OUTSIDE_OPEN, OCCLUDERS_LAYERS, MASKED, STOCHASTIC, EARLY_OUT,
//    COMPENSATED, STEREO, ESTIMATE_MONO, WITH_HALF_OCCLUSION
#include "gtao/closed_slices.h"

kernel void gtao_estimate(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                          OCCLUDERS_ARGUMENT ROUGHNESS_ARGUMENT WANTED_ARGUMENT PLANE_OUT ao_raw
                              OPEN_DIRECTIONS_ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(1), ao_raw, here); STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections directions = whole_hemisphere(r.normal);
  SET_LOBE(directions, r)
  real open = 1;
  real3 light;
  if (ANY(!r.point.background)) {
    const Search search = search_of(params, r);
    // A slice that is not parallel to the image plane reaches further on the screen than the radius at the pixel's depth.
    const Reach widest = longer(r.reach, search.surface.length);
    LOOK_AROUND(open, frame, r, widest, open_share(frame, params, layers, search, within, &directions, &light))
  }
  store_open(open, r, ao_raw);
  STORE_OPEN_DIRECTIONS(directions, r)
}

#if STEREO
#include "shared/stereo/slice_view.h"

static inline Taken taken_by_either(Taken a, Taken b) {
#if BITMASK
  return a | b;
#else
  return larger(a, b);
#endif
}

// A surface that both eyes see closes each eye's slice as that eye sees it, and the mean of both counts; a surface that one eye
// alone sees closes both, and counts as in the slice of the eye that it closes more of. Section 3.1 combines obscurance sample by
// sample. Horizons combined so are too low, as two samples rarely meet the highest occluder alike; sectors of one eye alone are
// noisier.
static inline real closed_by_both(View* own, View* other, real sine, real other_sine, Side* side, Side* other_side) {
  const Taken by_own_alone = taken_of(own->slice, sine, side->scale, &side->closed);
  const Taken by_other_alone = taken_of(other->slice, other_sine, other_side->scale, &other_side->closed);
  const Taken alone = taken_by_either(by_own_alone, by_other_alone);
  const real own_alone = share_of(by_own_alone), other_alone = share_of(by_other_alone), by_one = share_of(alone);
  const Taken by_own = taken_of(own->slice, sine, side->scale, &side->closed_for_both);
  const Taken by_other = taken_of(other->slice, other_sine, other_side->scale, &other_side->closed_for_both);
  const real more_by_own = share_of(taken_by_either(by_own, alone)) - by_one;
  const real more_by_other = share_of(taken_by_either(by_other, alone)) - by_one;
  const real mean = (scalar)0.5 * (own->importance + other->importance);
  const real of_larger =
      choose(own_alone > other_alone, own->importance, choose(own_alone < other_alone, other->importance, mean));
  return of_larger * by_one + (scalar)0.5 * (own->importance * more_by_own + other->importance * more_by_other);
}

// Both sides of a slice, times its importance.
static inline real closed_to_both(Search here, Search there, View* own, View* other, mask is_seen) {
  return closed_by_both(own, other, own->slice.sine, other->slice.sine, &own->right, &other->right) +
         closed_by_both(own, other, -own->slice.sine, -other->slice.sine, &own->left, &other->left);
}

#include "shared/stereo/slices.h"
#endif
