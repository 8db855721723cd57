// Light that surfaces near by send to each pixel: indirect light by the sectors of slices (Therrien, Levesque, Gilet 2023). A sector
// gets the radiance of the first sample that covers it:
//   indirect = mean over slices of the sum over samples of (share of the slice's cosine-weighted mass that the sample covers first)
//              * radiance of the sample, where its surface faces the pixel
// Sectors of equal cosine-weighted mass hold the receiver's cosine; the solid angle that a sample covers holds the sender's.
//
// in : depth      view-space z, scene units, +inf = background
//      normal     unit, view space
//      color      radiance that leaves each pixel, the same in every direction
//      other_depth, other_sources  of the other eye (shared/stereo/slices.h)
//      occluders  further depth layers (layers.h); light_r ... light_normal_z  their radiance and normals. Without these, and of
//                 stochastic depths, hidden surfaces close sectors and send nothing
// out: indirect_raw  irradiance / pi, in the unit of color, unfiltered; 0 on background
//      ao_raw        as bitmask makes it, to the last bit (WITH_AO_RAW)
//      bent_normal, cone, specular_occlusion_raw, lobe_weight  as bitmask makes them (WITH_...)
// -D as gtao.cl, with LIGHT
#include "gtao/closed_slices.h"

// in : normal, color
// out: sources
kernel void pack_sources(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real3 color = bounded_radiance(load3(color_r, color_g, color_b, here), params.brightest);
  store_light_source(color, load3(normal_x, normal_y, normal_z, here), sources, here);
}

#ifdef LIGHT_R_LAYERS
#define LIGHT_SOURCES \
  { light_r, light_g, light_b, light_normal_x, light_normal_y, light_normal_z, params.brightest }
#else
#define LIGHT_SOURCES \
  { sources }
#endif
static inline void store_light(real3 light, mask counts, PLANE_OUT r, PLANE_OUT g, PLANE_OUT b, int here) {
  store(choose(counts, light.x, (real)(0)), r, here);
  store(choose(counts, light.y, (real)(0)), g, here);
  store(choose(counts, light.z, (real)(0)), b, here);
}

// in : depth, normal; sources, occluders, light_r, light_g, light_b, light_normal_x, light_normal_y, light_normal_z,
//      roughness, wanted
// out: indirect_raw; ao_raw, bent_normal, cone, specular_occlusion_raw, lobe_weight
kernel void indirect_estimate(ARGUMENTS) {
  SKIP_UNWANTED(frame, store((real)(0), indirect_raw_r, here); store((real)(0), indirect_raw_g, here);
                store((real)(0), indirect_raw_b, here); STORE_NO_AO_RAW STORE_NO_DIRECTIONS)
  const DepthLayers layers = LAYERS_FROM(frame, depth);
  Receiver r = receiver_at(frame, params.radius, params.max_reach, depth, normal_x, normal_y, normal_z);
  leave_out(&r, is_wanted);
  OpenDirections directions = whole_hemisphere(r.normal);
  SET_LOBE(directions, r)
  real open = 1;
  real3 light = make3((real)(0), (real)(0), (real)(0));
  if (ANY(!r.point.background)) {
    Search search = search_of(params, r);
    const LightSources light_sources = LIGHT_SOURCES;
    search.sources = light_sources;
    const Reach widest = longer(r.reach, search.surface.length);
    LOOK_AROUND(open, frame, r, widest, open_share(frame, params, layers, search, within, &directions, &light))
  }
  store_light(light, !r.point.background, indirect_raw_r, indirect_raw_g, indirect_raw_b, r.here);
  STORE_AO_RAW(open, r)
  STORE_OPEN_DIRECTIONS(directions, r)
}

#if STEREO
#include "gtao/both_eyes.h"
#endif
