// What the back-check of a reprojection is worth.
#pragma once

#include <string>

#include "bench/papers/study.h"

namespace gloam::bench {

/// Shi, Billeter, Eisemann 2022, figure 5: what the second eye takes from the first with and without the back-check,
/// against what it finds by itself. States the inconsistency of `filtered`, and of the pixels of `raw` where one way alone
/// is farther off than the other, how many they are and how far off; draws the part of the image that holds most of those
/// that the check mends. Both ask for a technique with STEREO_PARAMS (shared/stereo/params.h), of a stage with two eyes.
void figure_5(Study& study, const Stage& s, const std::string& scene, const Asked& raw, const Asked& filtered);

}  // namespace gloam::bench
