// Parameters of techniques that estimate for two eyes (Shi, Billeter, Eisemann 2022).
#ifndef GLOAM_STEREO_PARAMS_H
#define GLOAM_STEREO_PARAMS_H

#include "shared/filter/bilateral_params.h"

#define BACK_CHECK_PARAMS(P)                  \
  P(float, back_check, 0.6f, 0, 64, "pixels", \
    "how far from itself a pixel may come back, projected to the other eye and back, and count as seen by both")

#define STEREO_FILTER_PARAMS(P)       \
  BILATERAL_PARAMS(P)                 \
  P(float, blend, 0.05f, 0, 0.5f, "", \
    "how far from one half an eye's share of the weight may be before one eye alone counts")

#define STEREO_PARAMS(P)                                                                                            \
  P(choice, estimate, stereo, (mono, stereo), "from what one eye sees, or both")                                    \
  P(choice, other_eye, near, (near, everywhere),                                                                    \
    "where an estimate from both looks at the other eye: within the radius of what that alone sees, or everywhere") \
  P(choice, reproject, on, (off, on, no_back_check),                                                                \
    "whether the second eye takes what the first found where both see the surface; no_back_check: or nearly so")    \
  P(choice, filter, stereo, (mono, stereo, stereo2d),                                                               \
    "over what one eye sees, or both, along rows and then columns; or both and all taps of the square at once")     \
  P(choice, primary, left, (left, right), "the eye that is estimated first: the first view, or the second")         \
  BACK_CHECK_PARAMS(P)                                                                                              \
  STEREO_FILTER_PARAMS(P)

#endif
