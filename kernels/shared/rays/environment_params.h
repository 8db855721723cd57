// Where the light of an environment comes from. `without`: the light without a map.
#ifndef GLOAM_ENVIRONMENT_PARAMS_H
#define GLOAM_ENVIRONMENT_PARAMS_H

#define ENVIRONMENT_PARAMS(P, without)                                                                           \
  P(file, environment, "light from far away: an EXR file with a lat-long map; none: " without)                   \
  P(choice, environment_axes, openexr, (openexr, blender),                                                       \
    "how the world lies in the map: openexr: +y is up and its middle looks along +z; blender: +z is up and its " \
    "middle looks along +x")                                                                                     \
  P(float, environment_turn, 0, -360, 360, "degrees",                                                            \
    "turns the map about the up axis, counter-clockwise seen from above")

#endif
