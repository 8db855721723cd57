#include "shared/both/params.h"

// The light, and how far it is followed.
#define CONTACT_LIGHT_PARAMS(P)                                                                                       \
  P(float, length, 0.5f, 0, INFINITY, "scene units", "distance from the surface up to which something shades it")     \
  P(float, max_reach, 0.25f, 0, 1, "image widths", "cap on the length on the screen")                                 \
  P(float, thickness, 0.4f, 0, INFINITY, "lengths", "how far an occluder reaches behind its visible front")           \
  P(choice, light, sun, (sun, directional, point), "sun: as the frame states it (gloamLight), else from straight up") \
  P(float, light_x, 0, -1e30f, 1e30f, "",                                                                             \
    "direction towards a directional light; place of a point light, scene units")                                     \
  P(float, light_y, 1, -1e30f, 1e30f, "", "likewise")                                                                 \
  P(float, light_z, 0, -1e30f, 1e30f, "", "likewise")                                                                 \
  P(choice, light_in, world, (world, view),                                                                           \
    "space of light_x, light_y and light_z; of a camera without a pose only view space is known")

#define CONTACT_SHADOW_PARAMS(P)                               \
  CONTACT_LIGHT_PARAMS(P)                                      \
  P(int, steps, 16, 1, 1024, "", "samples towards the light")  \
  P(bool, jitter, on, "shift the samples from pixel to pixel") \
  P(float, bias, 0.01f, 0, 1, "", "what rises over the tangent plane by a lower sine does not count")

#define CONTACT_MASK_PARAMS(P)                                                                           \
  CONTACT_LIGHT_PARAMS(P)                                                                                \
  P(int, search_steps, 16, 1, 64, "", "samples towards the light from the pixel that stands for a cell") \
  P(float, least_sine, 0.01f, 0.00048828125f, 1, "",                                                     \
    "something may shade if it rises over the tangent plane by at least this sine")                      \
  P(int, cell, 4, 2, 16, "pixels", "width and height of a cell of the mask")

PARAMS(ContactShadowParams, CONTACT_SHADOW_PARAMS)
PARAMS(ContactMaskParams, CONTACT_MASK_PARAMS)
