// The best fit of a submission's images to their truths: an exponent and a strength for shares, a factor for light.
#pragma once

#include <optional>
#include <vector>

#include "measure/measures.h"

namespace gloam::score {

/// image -> 1 - strength * (1 - image^exponent) for shares, scale * image for light.
struct BestFit {
  double exponent = 1, strength = 1, scale = 1;
  double rmse = 0;  ///< over all pixels of all images
};

/// Sums over pixels, from which the fit follows: images need not be kept.
class FitSums {
 public:
  /// `is_of_shares`: values from 0 to 1.
  explicit FitSums(bool is_of_shares) : is_of_shares_(is_of_shares), bins_(is_of_shares ? bin_count : 0) {}

  /// Adds the foreground of the views that both images have.
  void add(const bench::Image& image, const bench::Image& truth, const bench::Foreground& foreground);
  FitSums& operator+=(const FitSums& other);

  /// By least squares over all pixels; none without pixels, and where no image says anything (all open, all black).
  std::optional<BestFit> best() const;
  /// Of image and truth, -1 to 1; none where one of them is even.
  std::optional<double> correlation() const;
  /// Root of the mean square of image - truth.
  double rmse() const;

 private:
  /// Shares are sums of many equal or near values: of a bin of 1/4096, the mean stands for all.
  static constexpr size_t bin_count = 4097;
  struct Bin {
    double count = 0, value = 0, truth = 0;
  };
  struct Squares {
    double error;
    double strength;
  };
  Squares squares_of(double exponent) const;

  bool is_of_shares_;
  std::vector<Bin> bins_;
  double count_ = 0, value_ = 0, truth_ = 0, value_squared_ = 0, truth_squared_ = 0, product_ = 0;
};

/// An image as the fit makes it; shares are clamped to 0 to 1.
bench::Image fitted(const bench::Image& image, const BestFit& fit, bool is_of_shares);

}  // namespace gloam::score
