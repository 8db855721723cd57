// The errors of a stereo pair as an image, to be written or put on a sheet.
#pragma once

#include <opencv2/core.hpp>

#include "gloam/stereo_consistency.h"

namespace gloam {

/// What `write_inconsistency_picture` (gloam/stereo_pictures.h) writes: CV_8UC3, of the plane's size.
cv::Mat inconsistency_image(const Plane& shown, const StereoErrors& errors, double magnify);

}  // namespace gloam
