// What a submitted row says besides its figures (gloam score).
#pragma once

#include <string>

#include "results/measurements.h"

namespace gloam::report {

/// Empty where the file does not say it, or says something of another type.
struct SubmittedFacts {
  std::string version, link, device, authors,
      convention;  ///< link: http or https; convention: what differs from plain, in words
  Number stated_ms, fit_rmse, fit_ssim, fit_flip, fit_exponent, fit_strength, fit_scale, whole_ms, whole_gloam_ms,
      whole_ratio;
};

SubmittedFacts facts_of(const Json& submitted);

/// A row of the page with `submitted`: the facts by name; its times are null, since none is measured as those of gloam are.
Json submitted_row(const Row& row, Json on_page);

}  // namespace gloam::report
