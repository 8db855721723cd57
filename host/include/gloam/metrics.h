// How far one image is from another.
#pragma once

#include <optional>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Figures over the pixels where `mask` says so. Differences are test - truth.
/// For a plane of several components each figure is over all of them; ssim and gmsd are means over components.
struct Metrics {
  long long pixels = 0;
  double mae = 0;              ///< mean absolute difference
  double rmse = 0;             ///< root of the mean squared difference
  double bias = 0;             ///< mean difference; > 0: the test is too bright
  std::optional<double> psnr;  ///< dB for a peak of 1; none for identical images
  double max = 0;              ///< largest absolute difference
  double over_1_255 = 0;       ///< share of pixels whose absolute difference is over 1/255
  double over_0_05 = 0;        ///< share of pixels over 0.05
  double ssim = 0;             ///< mean of OpenCV's SSIM map over the mask, images scaled to 0..255
  double gmsd = 0;             ///< standard deviation of OpenCV's gradient-magnitude similarity map over the mask
  /// Of colours alone: mean of the FLIP map (flip.h) of what a screen shows of them, cut off at 0 and 1.
  std::optional<double> flip;
  /// Of colours alone: mean relative squared error, (test - truth)^2 / (truth^2 + 0.01).
  std::optional<double> rse;
};

/// Which pixels count: `foreground[y * width + x] != 0`.
using Mask = std::vector<unsigned char>;

/// Throws Error when sizes or component counts differ, when no pixel is in the mask, or when a counted pixel of either
/// image is not finite (naming the first such pixel).
/// With an `exposure` above 0 the planes are radiance: ssim, gmsd and flip are of what a screen shows of it, multiplied by the
/// exposure, cut off at 0 and 1 and, for ssim and gmsd, through sRGB. All other figures are of the values as they are.
Metrics compare(const Plane& test, const Plane& truth, const Mask& foreground, double exposure = 0);

}  // namespace gloam
