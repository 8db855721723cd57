// Coefficients of the technique `evidence`: least squares over filtered terms, of the closed share of ray-traced truth and of the error
// that is left.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "evidence/coefficients.h"
#include "fit/training.h"
#include "gloam/device.h"

namespace gloam::bench {

/// All terms that the kernel makes: those of AO, the roots that the error is fitted to, and the square of the share of samples outside of the image.
constexpr int fitted_terms = closed_terms + 3;

/// One pixel: its filtered terms, the truth, what other techniques read there, and its distance to the border of the image over the
/// image's width.
struct FitSample {
  std::array<float, fitted_terms> terms;
  float truth = 1, gtao = 1, bitmask = 1, to_border = 0;
};

/// What a set of coefficients is for: who the occluders are known by (EvidenceSet), slices a pixel, and samples on each side of a
/// slice.
struct Sampling {
  std::string occluders;
  int directions, steps;
};

/// The pixels of a frame, after the default filter.
std::vector<FitSample> fit_samples(const TrainingFrame& training, const Sampling& sampling, Device& device);

/// Pixels of one kind of scene, and how much each counts.
struct FitGroup {
  const std::vector<FitSample>* samples;
  double weight;
};

/// What has been fitted.
struct Fit {
  std::array<double, closed_terms> closed{};
  std::array<double, error_terms> error{};
  double outside = 0;
  /// AO, and its expected absolute error.
  double ao(const FitSample& sample) const;
  double expected_error(const FitSample& sample) const;
};

/// Ridge regression for samplings that know occluders by the same means, a list of groups for each. Pixels that are open count
/// `weight_of_open` times. What is unknown does not depend on the number of samples: coefficients of terms with `u` or `n` are common to
/// all samplings, so that more samples never make an estimate surer of what no sample sees. Throws Error for fewer pixels than terms.
std::vector<Fit> fitted(const std::vector<std::vector<FitGroup>>& samplings);

/// Fits the error of a sampling whose AO is fitted: by terms, and by how much it grows where samples lie outside of the image.
void fit_error(const std::vector<FitGroup>& groups, Fit& fit);

/// Pixels with at least this truth are open. Dark spots on them are seen before errors of the same size elsewhere, so they weigh more.
constexpr float least_open = 0.97f;
constexpr double weight_of_open = 4;

/// Share of the open pixels that are more than .03 too dark; 0 where none is open.
double share_too_dark(const std::vector<FitSample>& samples, const Fit& fit);

/// Root mean square error to the truth, of AO clamped to 0 to 1 after the filter. (The technique clamps before the filter.)
double rmse(const std::vector<FitSample>& samples, const Fit& fit);
double rmse(const std::vector<FitSample>& samples, float FitSample::*ao);

/// Expected and actual absolute error of a tenth of the pixels.
struct Decile {
  double expected, actual;
};

/// Pixels by expected error, the smallest first.
std::vector<Decile> deciles(std::vector<std::pair<double, double>> expected_and_actual);

}  // namespace gloam::bench
