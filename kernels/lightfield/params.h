#include "shared/sampling/ambient_occlusion.h"

#define REUSE_PARAMS(P, from)                                                                                 \
  P(bool, reuse, off, "take over what key views have found of the same points, and compute only what is new") \
  P(int, key_views, 4, 2, 64, "views", "every so many views one is a key view, computed in full")             \
  P(choice, reuse_from, from, (both, nearest),                                                                \
    "where the key views on both sides show a point, their mean or the nearest's")                            \
  P(float, back_check, 1, 0.5f, 16, "pixels", "a key view shows the same point if the way there and back ends so near")

#define LIGHTFIELD_SSAO_PARAMS(P)                                                                                    \
  REACH_PARAMS(P)                                                                                                    \
  P(int, samples, 8, 1, 256, "", "points looked at per pixel and radius")                                            \
  P(int, radii, 5, 1, 8, "", "radii from the largest on, each `ratio` times the one before; what takes most counts") \
  P(float, ratio, 0.5f, 0.1f, 0.95f, "", "of a radius to the one before")                                            \
  P(choice, points, spiral, (spiral, random, jittered, latin_square, poisson_disk), "how the points are spread")     \
  P(bool, hemisphere, on, "points in the half of the ball above the surface; off: in all of it, as in the paper")    \
  P(float, inner, 0, 0, 0.99f, "radii",                                                                              \
    "points lie further away than this: a shell instead of a ball; the paper's is 0.8")                              \
  P(float, bias, 0.02f, 0, 0.99f, "",                                                                                \
    "slope above the surface up to which what is seen occludes no point of the half ball")                           \
  P(float, range, 2, 0, INFINITY, "radii",                                                                           \
    "how far before the pixel's point an occluder counts in full; nothing from twice that on")                       \
  REUSE_PARAMS(P, both)

#define LIGHTFIELD_HBAO_PLUS_PARAMS(P)                                                                        \
  REACH_PARAMS(P)                                                                                             \
  P(float, bias, 0.1f, 0, 0.99f, "", "cosine above the tangent plane below which an occluder does not count") \
  P(int, directions, 8, 1, 32, "", "directions searched per pixel")                                           \
  P(int, steps, 4, 1, 32, "", "samples along each direction")                                                 \
  P(float, strength, 1, 0, 8, "", "factor on the obscurance")                                                 \
  P(choice, falloff, quadratic, (quadratic, none), "how an occluder fades towards the radius")                \
  REUSE_PARAMS(P, nearest)

#define LIGHTFIELD_MASK_PARAMS(P)                                                                      \
  REACH_PARAMS(P)                                                                                      \
  P(int, search_directions, 8, 1, 32, "", "directions searched from the pixel that stands for a cell") \
  P(int, search_steps, 3, 1, 32, "", "samples along each direction")                                   \
  P(float, least_sine, 0.02f, 0.001f, 1, "",                                                           \
    "of the elevation over the tangent plane from which on something occludes")                        \
  P(int, cell, 4, 2, 16, "pixels", "width and height of the cells that are wanted or not")

PARAMS(LightfieldMaskParams, LIGHTFIELD_MASK_PARAMS)
PARAMS(LightfieldSsaoParams, LIGHTFIELD_SSAO_PARAMS)
PARAMS(LightfieldHbaoPlusParams, LIGHTFIELD_HBAO_PLUS_PARAMS)
