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

// in : depth, normal; roughness, wanted, occluders
// out: ao_raw; bent_normal, cone, specular_occlusion_raw, lobe_weight
kernel void gtao_estimate(ARGUMENTS) {
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
#include "gtao/both_eyes.h"
#endif
