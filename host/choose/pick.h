// The best setting for one frame and device, by measurement.
#pragma once

#include <string>
#include <vector>

#include "measure/contest.h"

namespace gloam::bench {

struct Picked {
  std::vector<Choice> finalists;  ///< sorted by time
  size_t tried = 0;               ///< number of settings tried
  size_t best = 0;                ///< index of the best finalist
  std::string truth;              ///< reference of the errors: "the truth", or its stand-in
  bool has_truth = true;          ///< it is no stand-in
  std::vector<Skipped> skipped;
  std::vector<Skipped> left_out;  ///< as of a contest
};

/// Holds a contest of the presets of the techniques at full and at half resolution. If the
/// subject has no truth, errors are to the converged image of the technique that is nearest to ray-traced truth on the built-in
/// scenes (of effects other than ambient occlusion: of the first technique). If one of the techniques makes an image of only the first of two views, times and errors of all are those of the first
/// view. Throws Error that names the nearest miss if nothing is within the bound.
Picked pick(const Subject& subject, const PickOptions& options, Device& device);

}  // namespace gloam::bench
