// Light of an environment that the closed directions of slices would send. Each side of a slice is divided into a few ranges of
// elevation. The closed share of a range is known as for ambient occlusion; its light is read in one direction within it, another one from
// pixel to pixel, so that neighbours show all of the environment. That light is blurred to texels of 22 degrees: a sun would be met by few
// pixels, and cost these more light than there is. (With texels of 11 degrees the RMSE under a low sun was 5 % higher.)
// -D RAYS: ranges on each side; JITTER
#ifndef GLOAM_MISSING_LIGHT_H
#define GLOAM_MISSING_LIGHT_H

#include "shared/sampling/slice_rays.h"

// Closed sectors of a range from `low` to `high`, of which those below `horizon` (counts of sectors) are closed to one degree.
static inline real closed_sectors(const Side* s, real horizon, real low, real high) {
  const real within = count_of(s->closed.covered & sectors_between(low, high)), all = high - low;
  const real below = smaller(larger(horizon - low, (real)(0)), all);
  const real either = smaller(larger(below, within), all);
  return within * s->degrees.within_thickness + (either - smaller(within, either)) * s->degrees.below_horizon +
         (all - either) * s->degrees.elsewhere;
}

static inline real sectors_at(real cosine, const Side* s) {
  return smaller(larger(quick_sectors_below(2 * cosine, s->scale), (real)(0)), (real)(MOST_SECTORS));
}

// The surface's normal, projected to the plane of the slice: of length 1.
static inline real3 normal_within(Search search, Slice slice) {
  const real3 v = search.surface.to_eye, t = slice.tangent;
  return make3(slice.sine * t.x + slice.cosine * v.x, slice.sine * t.y + slice.cosine * v.y,
               slice.sine * t.z + slice.cosine * v.z);
}

// Adds what a side's closed ranges would send, times the share of the slice that they close. `sign`: of the side.
static inline __attribute__((always_inline)) void add_missing_of_side(real3* light, real* closed, Search search,
                                                                      Slice slice, real shift, scalar sign,
                                                                      const Side* s) {
  const real3 v = search.surface.to_eye, t = slice.tangent;
  // Up from the surface's tangent, and along it to this side.
  const real3 up = normal_within(search, slice);
  const real3 out =
      make3(sign * (slice.cosine * t.x - slice.sine * v.x), sign * (slice.cosine * t.y - slice.sine * v.y),
            sign * (slice.cosine * t.z - slice.sine * v.z));
  const real horizon = sectors_at((scalar)0.5 * s->closed.lowest, s);
  real high = sectors_at(-s->sine, s);
  for (int k = 0; k < RAYS; ++k) {
    // The mass falls nearly along a straight line from the tangent to the line to the eye: ranges of the square of the cosine's
    // place between the two hold about as much each.
    const real next = (1 + s->sine) * sqrt((real)((scalar)((k + 1) * (1.0f / RAYS)))) - s->sine;
    const real low = sectors_at(next, s);
    const real share = closed_sectors(s, horizon, low, larger(high, low)) * s->share;
    high = low;
    if (!ANY(share > 0)) continue;
    const real cosine = (1 + s->sine) * sqrt(((scalar)k + shift) * (scalar)(1.0f / RAYS)) - s->sine;
    const real above = sqrt(larger(1 - cosine * cosine, (real)(0)));
    const real3 radiance = coarse_radiance(
        search.environment,
        make3(up.x * above + out.x * cosine, up.y * above + out.y * cosine, up.z * above + out.z * cosine));
    light->x = multiply_add(share, radiance.x, light->x);
    light->y = multiply_add(share, radiance.y, light->y);
    light->z = multiply_add(share, radiance.z, light->z);
    *closed += share;
  }
}

// Adds a slice's missing light: the mean of what its closed ranges would send, times the share of all slices that it closes, so that even
// light is missing as ambient occlusion has it.
static inline __attribute__((always_inline)) void add_missing_light(real3* missing, real closed_share, Search search,
                                                                    Slice slice, real turn, const Side* right,
                                                                    const Side* left) {
  if (!ANY(closed_share != 0)) return;
  real3 light = make3((real)(0), (real)(0), (real)(0));
  real closed = (real)(0);
  const real shift = turn - floor(turn);
  add_missing_of_side(&light, &closed, search, slice, shift, (scalar)1, right);
  add_missing_of_side(&light, &closed, search, slice, 1 - shift, (scalar)-1, left);
  // What the fit expects of a slice that shows nothing, below 0 too, is missing from above the surface.
  const mask is_anywhere = closed > 0;
  if (ANY(!is_anywhere)) {
    const real3 above = coarse_radiance(search.environment, normal_within(search, slice));
    light = make3(choose(is_anywhere, light.x, above.x), choose(is_anywhere, light.y, above.y),
                  choose(is_anywhere, light.z, above.z));
  }
  const real share = quotient(closed_share, choose(is_anywhere, closed, (real)(1)));
  missing->x = multiply_add(share, light.x, missing->x);
  missing->y = multiply_add(share, light.y, missing->y);
  missing->z = multiply_add(share, light.z, missing->z);
}

#endif
