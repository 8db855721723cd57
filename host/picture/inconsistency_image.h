// The errors of a stereo pair as an image.
#pragma once

#include <opencv2/core.hpp>

#include "gloam/stereo_consistency.h"

namespace gloam {

/// The image of `write_inconsistency_picture` (gloam/stereo_pictures.h): CV_8UC3, of the plane's size.
cv::Mat inconsistency_image(const Plane& shown, const StereoErrors& errors, double magnify);

/// Colour of a pixel that does not count: purple at half strength over the plane's colour, so that it stays dark where that is
/// dark, and purple where that is bright.
cv::Vec3b hidden_tone(const cv::Vec3b& colour);

}  // namespace gloam
