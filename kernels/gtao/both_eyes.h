// What closes a slice for two eyes (Shi, Billeter, Eisemann 2022), and with LIGHT what lights it.
// -D as gtao.cl
#ifndef GLOAM_BOTH_EYES_H
#define GLOAM_BOTH_EYES_H

#include "gtao/closed_slices.h"
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

#if LIGHT
// The same elevations in both eyes' slices. `shift`: shift_of_slice.
static inline void start_rays_of_view(View* view, real shift) {
  const Slice s = view->slice;
  start_rays(view->right.rays, shift, s.cosine, s.sine, s.mass);
  start_rays(view->left.rays, 1 - shift, s.cosine, -s.sine, s.mass);
}

// Whether a ray that this eye saw end at a surface that it alone sees ends there for both eyes: nothing that the other eye shows ends it
// sooner.
static inline mask ends_for_both(LightRay ray, LightRay other) {
  const mask ends = to_mask(ray.source != NO_SOURCE), other_ends = to_mask(other.source != NO_SOURCE);
  const mask by_one = to_mask((ray.source & 1) == 0) | to_mask(ray.source == DARK_SOURCE);
  return ends & by_one & (!other_ends | (ray.distance < other.distance));
}

// As for what closes a slice: of surfaces that both eyes see the mean of what each finds counts, and of a surface that one eye alone sees
// all that this eye finds, in the colour in which it sees the surface.
static inline void add_light_of_both(real3* light, LightRay own, LightRay other, real importance, real other_importance,
                                     Search here, Search there, SideAxes axes, SideAxes other_axes) {
  const mask is_sent = sends(own), other_sent = sends(other);
  if (!ANY(is_sent | other_sent)) return;
  const RayLight a = light_of_ray(importance, own, here.sources, 0, axes, is_sent);
  const RayLight b = light_of_ray(other_importance, other, there.sources, 0, other_axes, other_sent);
  const real of_own =
      choose(ends_for_both(own, other), (real)(1), choose(ends_for_both(other, own), (real)(0), (real)(0.5f)));
  const real share = of_own * a.share, other_share = (1 - of_own) * b.share;
  light->x += share * a.source.radiance.x + other_share * b.source.radiance.x;
  light->y += share * a.source.radiance.y + other_share * b.source.radiance.y;
  light->z += share * a.source.radiance.z + other_share * b.source.radiance.z;
}

static inline void add_light_of_sides(real3* light, Search here, Search there, const View* own, const View* other,
                                      const Side* side, const Side* other_side, scalar sign) {
  const SideAxes axes = axes_of_side(own->slice, here.surface.to_eye, sign);
  const SideAxes other_axes = axes_of_side(other->slice, there.surface.to_eye, sign);
  const scalar share = (scalar)(1.0f / DIRECTIONS);
#define ADD(k)                                                                                                     \
  add_light_of_both(light, side->rays[k], other_side->rays[k], share * own->importance, share * other->importance, \
                    here, there, axes, other_axes);
  FOR_EACH_RAY(ADD)
#undef ADD
}

// Both sides of a slice.
static inline void add_light_to_both(real3* light, Search here, Search there, const View* own, const View* other) {
  add_light_of_sides(light, here, there, own, other, &own->right, &other->right, (scalar)1);
  add_light_of_sides(light, here, there, own, other, &own->left, &other->left, (scalar)-1);
}
#endif

#include "shared/stereo/slices.h"
#endif
