// How far one image is from another.
#pragma once

#include <optional>
#include <string>
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

/// Rows of the two images and what of them counts, for a comparison that never holds all of them. All three begin with row `top`
/// of the image.
struct ComparedRows {
  const Plane &test, &truth;
  const Mask& foreground;
  int top = 0;
};

/// What `compare` finds, to the same bits, of images that come some rows at a time.
class Comparison {
 public:
  /// Rows are added this many at a time, or a multiple.
  static constexpr int step = 256;
  /// Neighbours on both sides that the figures of a row depend on.
  static int reach();
  /// Memory that the figures take beside the rows, at most about.
  static unsigned long long bytes(int width, size_t components);

  /// Of images of this height. `exposure`: as above.
  explicit Comparison(int height, double exposure = 0) : height_(height), exposure_(exposure) {}
  /// Rows [first, last) of the image, from the top on and without a gap; `first` is a multiple of `step`. `rows` holds these and
  /// `reach()` more on both sides, as far as the image goes. Throws what `compare` throws.
  void add(const ComparedRows& rows, int first, int last);
  /// That counted so far.
  long long pixels() const { return sums_.pixels; }
  /// Throws Error where no pixel counted.
  Metrics figures() const;

 private:
  /// What the simple figures are made of. Doubles, added in pixel order on one thread: the same bits every time.
  struct Sums {
    long long pixels = 0, over_1_255 = 0, over_0_05 = 0;
    double absolute = 0, squared = 0, difference = 0, max = 0;
  };
  struct Mean {
    double sum = 0;
    long long count = 0;
    double value() const { return sum / double(count); }
  };
  /// Of values near 1, by what they are below it: no cancellation, and exactly 0 for equal images.
  struct Deviation {
    double sum = 0, squares = 0;
    long long count = 0;
    double value() const;
  };

  void add_pixel(const ComparedRows& rows, int x, int y);
  void add_simple(const ComparedRows& rows, int first, int last);
  void add_ssim(const ComparedRows& rows, size_t channel, int first, int last);
  void add_gmsd(const ComparedRows& rows, size_t channel, int first, int last);
  void add_flip(const ComparedRows& rows, int first, int last);
  void add_relative(const ComparedRows& rows, int first, int last);

  int height_;
  double exposure_;
  std::string name_, size_;
  Sums sums_;
  std::vector<Mean> ssim_;
  std::vector<Deviation> gmsd_;
  std::optional<Mean> flip_, relative_;
};

}  // namespace gloam
