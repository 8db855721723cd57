// Differences between two images.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Figures over the pixels in a mask. Differences are test - truth. For a plane of several components each figure is over all of
/// them; ssim and gmsd are means over components.
struct Metrics {
  long long pixels = 0;
  double mae = 0;              ///< mean absolute difference
  double rmse = 0;             ///< root of the mean squared difference
  double bias = 0;             ///< mean difference; > 0: the test is too bright
  std::optional<double> psnr;  ///< dB for a peak of 1; none for identical images
  double max = 0;              ///< largest absolute difference
  double over_1_255 = 0;       ///< share of pixels with an absolute difference over 1/255
  double over_0_05 = 0;        ///< share of pixels over 0.05
  double ssim = 0;             ///< mean of OpenCV's SSIM map over the mask, images scaled to 0..255
  double gmsd = 0;             ///< standard deviation of OpenCV's gradient-magnitude similarity map over the mask
  /// For colours only: mean of the FLIP map (flip.h) of the displayed colours, clamped to 0..1.
  std::optional<double> flip;
  /// For colours only: mean relative squared error, (test - truth)^2 / (truth^2 + 0.01).
  std::optional<double> rse;
};

/// The pixels that count: `foreground[y * width + x] != 0`.
using Mask = std::vector<unsigned char>;

/// Throws Error if sizes or component counts differ, if no pixel is in the mask, or if a counted pixel of either image is not
/// finite (naming the first such pixel). With an `exposure` above 0 the planes are radiance: ssim, gmsd and flip compare what a
/// screen shows, which is the radiance multiplied by the exposure, clamped to 0..1 and, for ssim and gmsd, through sRGB. All
/// other figures compare the values as they are.
Metrics compare(const Plane& test, const Plane& truth, const Mask& foreground, double exposure = 0);

/// Some rows of the two images and of the mask, for a comparison that never holds whole images. All three begin with row `top` of
/// the image.
struct ComparedRows {
  const Plane &test, &truth;
  const Mask& foreground;
  int top = 0;
};

/// As `compare`, to the same bits, for images that come some rows at a time.
class Comparison {
 public:
  /// Rows are added in multiples of this number.
  static constexpr int step = 256;
  /// Number of rows above and below on which the figures of a row depend.
  static int reach();
  /// Upper estimate of the memory of the figures besides the rows, bytes.
  static unsigned long long bytes(int width, size_t components);

  /// `height`: of the images, pixels. `exposure`: as for `compare`.
  explicit Comparison(int height, double exposure = 0) : height_(height), exposure_(exposure) {}
  /// Adds rows [first, last) of the image, from the top on and without a gap; `first` is a multiple of `step`. `rows` holds these
  /// and `reach()` more on both sides, as far as the image goes. Throws as `compare` does.
  void add(const ComparedRows& rows, int first, int last);
  /// Pixels counted so far.
  long long pixels() const { return sums_.pixels; }
  /// Throws Error if no pixel counted.
  Metrics figures() const;

 private:
  /// Sums behind the simple figures: doubles, added in pixel order on one thread, so that the bits are the same every time.
  struct Sums {
    long long pixels = 0, over_1_255 = 0, over_0_05 = 0;
    double absolute = 0, squared = 0, difference = 0, max = 0;
  };
  struct Mean {
    double sum = 0;
    long long count = 0;
    double value() const { return sum / double(count); }
  };
  /// Mean of values near 1, from sums of their distance below 1: no cancellation, and exactly 0 for equal images.
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
