// Parameters of techniques whose occluders contribute obscurance (obscurance.h).
#ifndef GLOAM_OBSCURANCE_PARAMS_H
#define GLOAM_OBSCURANCE_PARAMS_H

#define OBSCURANCE_BIAS(P) \
  P(float, bias, 0.1f, 0, 0.99f, "", "cosine to the normal below which an occluder does not count")

#define OBSCURANCE_STRENGTH(P) P(float, strength, 1, 0, 8, "", "factor on the obscurance")

#define OBSCURANCE_FALLOFF(P) \
  P(choice, falloff, quadratic, (quadratic, none), "how an occluder fades towards the radius")

// Of those that search directions on the screen.
#define OBSCURANCE_SEARCH_PARAMS(P)                                 \
  OBSCURANCE_BIAS(P)                                                \
  P(int, directions, 8, 1, 32, "", "directions searched per pixel") \
  P(int, steps, 4, 1, 32, "", "samples along each direction")       \
  OBSCURANCE_STRENGTH(P)

#endif
