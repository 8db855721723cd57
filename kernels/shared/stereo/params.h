// Parameters of techniques that estimate for two eyes (Shi, Billeter, Eisemann 2022).
#ifndef GLOAM_STEREO_PARAMS_H
#define GLOAM_STEREO_PARAMS_H

#include "shared/both/params.h"
#include "shared/filter/bilateral_params.h"

#define BACK_CHECK_PARAMS(P)                  \
  P(float, back_check, 0.6f, 0, 64, "pixels", \
    "a pixel projected to the other eye and back counts as seen by both if it returns this close")

#define STEREO_FILTER_PARAMS(P)       \
  BILATERAL_PARAMS(P)                 \
  P(float, blend, 0.05f, 0, 0.5f, "", \
    "both eyes' values are mixed while an eye's share of the weight is this close to one half")

#define STEREO_PARAMS(P)                                                                                           \
  P(choice, estimate, stereo, (mono, stereo), "from one eye's depth, or from both eyes'")                          \
  P(choice, other_eye, near, (near, everywhere),                                                                   \
    "where an estimate from both uses the other eye: within the radius of what only that eye sees, or everywhere") \
  P(choice, reproject, on, (off, on, no_back_check),                                                               \
    "whether the second eye reuses the first's AO where both see the surface; no_back_check: by depth alone")      \
  P(choice, filter, stereo, (mono, stereo, stereo2d),                                                              \
    "over one eye (mono) or both, in one pass along rows and one along columns; stereo2d: in one over the square") \
  P(choice, primary, left, (left, right), "the eye that is computed first: the first view, or the second")         \
  BACK_CHECK_PARAMS(P)                                                                                             \
  STEREO_FILTER_PARAMS(P)

PARAMS(StereoParams, STEREO_PARAMS)

#endif
