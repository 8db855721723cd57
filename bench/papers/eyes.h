// Inconsistency of images of two eyes, for the papers that measure it.
#pragma once

#include <array>

#include "gloam/stereo_consistency.h"
#include "papers/study.h"

namespace gloam::bench {

/// For an image of each eye, made from the stage's frame. Throws as `stereo_inconsistency` does.
StereoInconsistency inconsistency(const Stage& s, const Image& ao, const StereoOptions& options = {});

/// For two views of a frame of many.
StereoInconsistency inconsistency(const Frame& frame, const std::array<size_t, 2>& views, const Image& ao,
                                  const StereoOptions& options = {});

/// The mean in `inconsistency_unit`.
double in_hundred_thousandths(const StereoFigures& figures);

}  // namespace gloam::bench
