#include "shared/both/params.h"
#include "shared/rays/environment_params.h"

// How a ray is followed.
#define RAY_PARAMS(P)                                                                                                 \
  P(choice, march, hierarchical, (hierarchical, linear),                                                              \
    "how a ray is followed: through cells that hold their nearest depth, or from pixel to pixel; both find the same " \
    "but for rounding")                                                                                               \
  P(choice, cells, min_max, (min_max, min),                                                                           \
    "what a cell holds: its nearest and its farthest depth, so that rays also pass behind surfaces in few steps, or " \
    "only the nearest")                                                                                               \
  P(int, max_steps, 1024, 1, 65536, "", "cells or pixels that a ray visits before it counts as a miss")               \
  P(float, thickness, 0.02f, 0, INFINITY, "depths", "how far a surface reaches behind its visible front")             \
  P(float, bias, 0.01f, 0, 1, "", "a hit counts as the surface itself below this sine of the angle to it")            \
  P(float, max_roughness, 0.8f, 0, 1, "", "surfaces rougher than this have no rays of their own")                     \
  P(float, max_distance, INFINITY, 0, INFINITY, "scene units", "longest ray; over its last quarter hits fade")

#define SSSR_PARAMS(P)                                                                                            \
  P(int, rays, 1, 1, 4, "", "rays per pixel")                                                                     \
  RAY_PARAMS(P)                                                                                                   \
  P(int, neighbours, 21, 1, 25, "pixels",                                                                         \
    "pixels whose rays each pixel uses, itself included, at most 2 columns or rows away")                         \
  P(float, fade_border, 0.05f, 0, 0.5f, "image sizes", "hits nearer to the border of the image than this fade")   \
  P(float, fade_facing, 0.9f, 0, 1, "", "rays back towards the eye fade from this cosine to the viewing axis on") \
  P(float, environment_r, 0, 0, 1e20f, "", "radiance where a ray finds no hit, red")                              \
  P(float, environment_g, 0, 0, 1e20f, "", "radiance where a ray finds no hit, green")                            \
  P(float, environment_b, 0, 0, 1e20f, "", "radiance where a ray finds no hit, blue")                             \
  ENVIRONMENT_PARAMS(P, "environment_r, _g, _b from everywhere")                                                  \
  P(bool, jitter, on, "vary the rays from pixel to pixel")

#define STEREO_SSR_PARAMS(P)                                                                                       \
  SSSR_PARAMS(P)                                                                                                   \
  P(choice, traversal, stereo, (stereo, mono),                                                                     \
    "a ray that leaves the image or passes behind a surface goes on in the other eye's image (stereo) or ends")    \
  P(choice, fade, stereo, (stereo, mono),                                                                          \
    "hits fade near the border of the eye's image that shows them nearer to its middle, or of the one that found " \
    "them")                                                                                                        \
  P(bool, reprojection, on, "use the other eye's rays that show the same virtual image")                           \
  P(int, other_neighbours, 21, 1, 25, "pixels", "pixels of the other eye whose rays each pixel uses")

#define TEMPORAL_SSSR_PARAMS(P)                                                                                     \
  SSSR_PARAMS(P)                                                                                                    \
  P(int, most_frames, 16, 1, 1024, "frames", "most frames in a pixel's mean; then the oldest fade")                 \
  P(float, same_depth, 0.05f, 0, INFINITY, "", "share by which a surface's depth may differ from the frame before") \
  P(float, kept_within, 3, 0, 1e6f, "mean deviations",                                                              \
    "how far the value from the frame before may be from the neighbours' mean; it is clamped to that")

#define REFLECTION_MASK_PARAMS(P) \
  RAY_PARAMS(P)                   \
  P(float, blurred, 0.2f, 0, 1, "", "from this roughness on, one direction does not tell what a surface reflects")

PARAMS(SssrParams, SSSR_PARAMS)
PARAMS(StereoSsrParams, STEREO_SSR_PARAMS)
PARAMS(TemporalSssrParams, TEMPORAL_SSSR_PARAMS)
PARAMS(ReflectionMaskParams, REFLECTION_MASK_PARAMS)
