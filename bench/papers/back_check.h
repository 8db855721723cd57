// The effect of the back-check of a reprojection.
#pragma once

#include <string>

#include "papers/study.h"

namespace gloam::bench {

/// Shi, Billeter, Eisemann 2022, figure 5: results that the second eye reuses with and without the back-check, compared with its
/// own result. States the inconsistency of `filtered`, and for `raw` the number and the error of pixels at which one of the two
/// ways alone is farther off; draws the part of the image that holds most of the pixels that the check corrects. Both need a
/// technique with STEREO_PARAMS (shared/stereo/params.h), on a stage with two eyes.
void figure_5(Study& study, const Stage& s, const std::string& scene, const Asked& raw, const Asked& filtered);

}  // namespace gloam::bench
