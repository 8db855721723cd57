// How alike an image and its truth look, besides the plain error: of every row of `gloam bench` and `gloam score`.
#pragma once

#include <optional>

#include "measure/measures.h"

namespace gloam::bench {

/// All figures of `gloam::compare`, and FLIP of a plane of one value too, as a grey picture (compare/grey_flip.h). Throws as `compare`.
Metrics metrics_of(const Plane& test, const Plane& truth, const Mask& foreground, double exposure = 0);

/// By the name of each view that both images and the foreground have.
std::map<std::string, Metrics> metrics_of_views(const Image& test, const Image& truth, const Foreground& foreground,
                                                double exposure = 0);

struct Similarity {
  std::optional<double> ssim, flip;  ///< over all views; none without a truth, and of an image that is not finite
};
Similarity similarity(const Image& test, const Image& truth, const Foreground& foreground);

/// Mean inconsistency of two views (gloam/stereo_consistency.h); none for another number of views or an image of one, without poses, and
/// where nothing can be compared.
std::optional<double> inconsistency(const Frame& frame, const Image& image);

}  // namespace gloam::bench
