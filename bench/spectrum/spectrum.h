// The spectrum of an error over flat surfaces: which wavelengths it has, and whether it is a pattern.
#pragma once

#include <array>

#include "gloam/frame.h"

namespace gloam::bench {

/// Wavelengths from 2, 4, 8 and 16 pixels up to twice that.
constexpr int spectrum_bands = 4;

struct Spectrum {
  int windows = 0;  ///< windows of 32 x 32 pixels that show one plane of which the truth is nearly even
  std::array<double, spectrum_bands> rms{};  ///< of the error within each band
  /// Power of the strongest frequency over the median power of those with wavelengths up to 8 pixels, in the mean over windows: a few
  /// for noise, tens or hundreds for a pattern that repeats.
  double peak = 0;
};

/// Of test - truth, one component each. A window counts where a plane fits to 1 / depth, or to depth, within a thousandth, and the
/// truth deviates from its mean by at most .03. Throws Error for images of different sizes, and where no window counts.
Spectrum spectrum_over_flat(const Channel& test, const Channel& truth, const Channel& depth);

}  // namespace gloam::bench
