// How far images of two eyes are from each other, for the papers that measure it.
#pragma once

#include "gloam/stereo_consistency.h"
#include "study.h"

namespace gloam::bench {

/// Of an image of each eye, made of the stage's frame. Throws what `stereo_inconsistency` throws.
StereoInconsistency inconsistency(const Stage& s, const Image& ao, const StereoOptions& options = {});

/// The mean in `inconsistency_unit`.
double in_hundred_thousandths(const StereoFigures& figures);

}  // namespace gloam::bench
