#include "shared/lanes/params.h"

// How a ray is followed.
#define RAY_PARAMS(P)                                                                                                \
  P(choice, march, hierarchical, (hierarchical, linear),                                                             \
    "how a ray is followed: by cells that know what is nearest in them, or from pixel to pixel; both find the same " \
    "but for rounding")                                                                                              \
  P(choice, cells, min_max, (min_max, min),                                                                          \
    "what cells know: the nearest and the farthest depth, so that rays pass behind things too in few steps, or the " \
    "nearest")                                                                                                       \
  P(int, max_steps, 1024, 1, 65536, "", "cells or pixels looked at before a ray is given up, and counts as a miss")  \
  P(float, thickness, 0.02f, 0, INFINITY, "depths", "how far a surface reaches behind what is seen of it")           \
  P(float, bias, 0.01f, 0, 1, "",                                                                                    \
    "sine of the angle to the surface below which what a ray meets is the surface itself")                           \
  P(float, max_roughness, 0.8f, 0, 1, "", "surfaces rougher than this have no rays of their own")                    \
  P(float, max_distance, INFINITY, 0, INFINITY, "scene units", "longest ray; over its last quarter hits fade")

#define SSSR_PARAMS(P)                                                                                         \
  P(int, rays, 1, 1, 4, "", "rays per pixel")                                                                  \
  RAY_PARAMS(P)                                                                                                \
  P(int, neighbours, 21, 1, 25, "pixels",                                                                      \
    "whose rays each pixel uses, its own among them, at most 2 columns or rows away")                          \
  P(float, fade_border, 0.05f, 0, 0.5f, "image sizes", "from where on hits near the border of the image fade") \
  P(float, fade_facing, 0.9f, 0, 1, "", "cosine to the axis of view from which on rays that come back fade")   \
  P(float, environment_r, 0, 0, 1e20f, "", "radiance that comes from where no hit is found")                   \
  P(float, environment_g, 0, 0, 1e20f, "", "the same, green")                                                  \
  P(float, environment_b, 0, 0, 1e20f, "", "the same, blue")                                                   \
  P(bool, jitter, on, "other rays from pixel to pixel")

#define STEREO_SSR_PARAMS(P)                                                                                         \
  SSSR_PARAMS(P)                                                                                                     \
  P(choice, traversal, stereo, (stereo, mono),                                                                       \
    "whether a ray that leaves the image or passes behind something goes on in the other eye's")                     \
  P(choice, fade, stereo, (stereo, mono),                                                                            \
    "hits fade near the border of the image that shows them nearer to its middle, or of the one they were found in") \
  P(bool, reprojection, on, "use the other eye's rays that show the same virtual image")                             \
  P(int, other_neighbours, 21, 1, 25, "pixels", "of the other eye whose rays each pixel uses")

#define TEMPORAL_SSSR_PARAMS(P)                                                                            \
  SSSR_PARAMS(P)                                                                                           \
  P(int, most_frames, 16, 1, 1024, "frames", "that a pixel is the mean of; from there on the oldest fade") \
  P(float, same_depth, 0.05f, 0, INFINITY, "",                                                             \
    "how much nearer or farther a surface may be than in the frame before, as a share")                    \
  P(float, kept_within, 3, 0, 1e6f, "mean deviations",                                                     \
    "how far what the frame before showed may be from the mean of the neighbours; what is farther is brought there")

#define REFLECTION_MASK_PARAMS(P) \
  RAY_PARAMS(P)                   \
  P(float, blurred, 0.2f, 0, 1, "", "roughness from which on one direction does not tell what a surface reflects")

PARAMS(SssrParams, SSSR_PARAMS)
PARAMS(StereoSsrParams, STEREO_SSR_PARAMS)
PARAMS(TemporalSssrParams, TEMPORAL_SSSR_PARAMS)
PARAMS(ReflectionMaskParams, REFLECTION_MASK_PARAMS)
