// Coefficients of the technique `evidence`: least squares of the closed share of ray-traced truth over filtered terms.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/fit/training.h"
#include "evidence/params.h"
#include "gloam/device.h"

namespace gloam::bench {

constexpr int evidence_terms = EVIDENCE_TERMS;

/// One pixel: its filtered terms, the truth, and what other techniques read there.
struct FitSample {
  std::array<float, evidence_terms> terms;
  float truth = 1, gtao = 1, bitmask = 1;
};

/// Slices a pixel, and samples on each side of a slice.
struct Sampling {
  int directions, steps;
};

using Coefficients = std::array<double, evidence_terms>;

/// Random surface pixels of a frame, the same each time, after the default filter. Throws Error for a frame without surfaces.
std::vector<FitSample> fit_samples(const TrainingFrame& training, Sampling sampling, Device& device, int pixels);

/// Ridge regression, pixels of all lists alike. Throws Error for fewer pixels than terms.
Coefficients fitted(const std::vector<const std::vector<FitSample>*>& samples);

/// Root mean square error to the truth, of AO clamped to 0 to 1 after the filter. (The technique clamps before the filter.)
double rmse(const std::vector<FitSample>& samples, const Coefficients& coefficients);
double rmse(const std::vector<FitSample>& samples, float FitSample::*ao);

}  // namespace gloam::bench
