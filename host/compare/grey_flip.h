// FLIP of planes of one value per pixel, as grey pictures.
#pragma once

#include "gloam/metrics.h"

namespace gloam {

/// Mean of the FLIP map (flip.h) over the foreground of two planes of values from 0 to 1, each shown as a grey picture: the values are
/// sRGB greys, as pictures of ambient occlusion are. Background is white in both. Throws Error as `compare` does for sizes.
double grey_flip(const Plane& test, const Plane& truth, const Mask& foreground);

}  // namespace gloam
