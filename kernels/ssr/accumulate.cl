// Reflections of a sequence: the mean over the frames that showed each surface (Stachowiak and Uludag 2015; Yang, Liu, Salvi 2020).
//
// in : depth, normal, roughness, reflectance  reflector.h
//      motion     pixels, from this frame to the one before, y down
//      reach, now of resolve.cl: length of the rays, and this frame's reflection
//      history, history_depth, history_frames  of the frame before, which `neighbour` shows
// out: reflection radiance towards the eye; a = share of it that was found in the image
//      frames     how many frames the reflection is the mean of
// -D MASKED
#include "shared/frame/history.h"
#include "shared/lanes/wanted.h"
#include "ssr/virtual_image.h"

// A reflection moves as its virtual image does, if what it shows stands still; otherwise, and on rough surfaces, it moves with the
// surface. Of these two positions in the frame before, the one counts whose value is nearer to the present neighbours. Mirrors have
// no noise: they use this frame alone.
// in : depth, normal, roughness, reflectance, motion, reach, now, history, history_depth, history_frames; wanted
// out: reflection, frames
kernel void ssr_accumulate(ARGUMENTS) {
  SKIP_UNWANTED(frame, no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
                store((real)(0), frames, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const mask counts = s.reflects & !s.is_mirror & is_wanted;
  if (!ANY(s.reflects)) {
    no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
    store((real)(0), frames, here);
    return;
  }
  const Past as_surface = past_at(frame, history_depth, history_frames, s.point.x + load(motion_x, here),
                                  s.point.y + load(motion_y, here), s.depth, params.same_depth, counts);
  const real length = load(reach, here);
  const Projection there = same_virtual_image(frame, neighbour, s, length, counts & (length > 0));
  const Past as_image = past_at(neighbour.frame, history_depth, history_frames, there.x, there.y, there.depth,
                                params.same_depth, there.is_seen);
  PLANE now[4] = {now_r, now_g, now_b, now_a};
  PLANE history[4] = {history_r, history_g, history_b, history_a};
  PLANE_OUT result[4] = {reflection_r, reflection_g, reflection_b, reflection_a};
  const Alike alike = alike_around(frame, depth, s.depth, params.same_depth);
  Around around_here[4];
  real of_surface[4], of_image[4],
      unlike = 0;  // excess of the surface's distance to the neighbours over the image's
  for (int c = 0; c < 4; ++c) {
    around_here[c] = around_of(frame, alike, now[c]);
    of_surface[c] = value_of(as_surface, history[c]);
    of_image[c] = value_of(as_image, history[c]);
    if (c < 3) unlike += fabs(of_surface[c] - around_here[c].mean) - fabs(of_image[c] - around_here[c].mean);
  }
  const mask takes_image = as_image.is_known & (!as_surface.is_known | (unlike >= 0));
  const mask is_known = as_surface.is_known | as_image.is_known;
  const real before =
      clamp(choose(takes_image, as_image.frames, as_surface.frames), (real)(0),
            (real)((scalar)params.most_frames - 1));
  const real share = quotient((real)(1), before + 1);
  for (int c = 0; c < 4; ++c) {
    const real own = choose(s.reflects & is_wanted, load(now[c], here), (real)(0));
    const real kept = kept_near(around_here[c], choose(takes_image, of_image[c], of_surface[c]), params.kept_within);
    store(choose(is_known, kept + (own - kept) * share, own), result[c], here);
  }
  store(choose(s.reflects & is_wanted, before + 1, (real)(0)), frames, here);
}
