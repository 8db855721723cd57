#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/mask_params.h"

#define REUSE_PARAMS(P, from)                                                                               \
  P(bool, reuse, off, "reuse the AO of key views for points that they show too, and compute only the rest") \
  P(int, key_views, 4, 2, 64, "views", "distance between key views, which are computed in full")            \
  P(choice, reuse_from, from, (both, nearest),                                                              \
    "where both neighbouring key views show a point: their mean, or the nearest's value")                   \
  P(float, back_check, 1, 0.5f, 16, "pixels", "a key view shows the same point if it projects back this close")

#define LIGHTFIELD_SSAO_PARAMS(P)                                                                                    \
  REACH_PARAMS(P)                                                                                                    \
  P(int, samples, 8, 1, 256, "", "points looked at per pixel and radius")                                            \
  P(int, radii, 5, 1, 8, "", "balls, each `ratio` times as large as the one before; the lowest AO counts")           \
  P(float, ratio, 0.5f, 0.1f, 0.95f, "", "ratio of a radius to the one before")                                      \
  P(choice, points, spiral, (spiral, random, jittered, latin_square, poisson_disk),                                  \
    "how the points are spread; all but the spiral are other points for each pixel and seed")                        \
  P(bool, hemisphere, on, "points in the half ball above the surface; off: in the whole ball, as in the paper")      \
  P(float, inner, 0, 0, 0.99f, "radii", "least distance of the points: a shell instead of a ball; 0.8 in the paper") \
  P(float, bias, 0.02f, 0, 0.99f, "",                                                                                \
    "slope above the surface up to which a visible surface occludes no point of the half ball")                      \
  P(float, range, 2, 0, INFINITY, "radii",                                                                           \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")             \
  REUSE_PARAMS(P, both)

#define LIGHTFIELD_HBAO_PLUS_PARAMS(P) \
  REACH_PARAMS(P)                      \
  OBSCURANCE_SEARCH_PARAMS(P)          \
  OBSCURANCE_FALLOFF(P)                \
  REUSE_PARAMS(P, nearest)

#define LIGHTFIELD_MASK_PARAMS(P) \
  REACH_PARAMS(P)                 \
  MASK_SEARCH_PARAMS(P)           \
  MASK_CELL(P)

PARAMS(LightfieldMaskParams, LIGHTFIELD_MASK_PARAMS)
PARAMS(LightfieldSsaoParams, LIGHTFIELD_SSAO_PARAMS)
PARAMS(LightfieldHbaoPlusParams, LIGHTFIELD_HBAO_PLUS_PARAMS)
