// Which setting to take on one frame and device: measured, not assumed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/measurement.h"

namespace gloam::bench {

/// What decides which image is nearer to the truth.
enum class PickBy { rmse, ssim, flip };
/// "RMSE", "SSIM" or "FLIP".
const char* name_of(PickBy by);

struct PickOptions {
  std::vector<const Technique*> techniques;
  std::optional<double> budget;  ///< milliseconds; the most accurate within it is picked
  std::optional<double> error;   ///< of the figure that decides; the cheapest within it is picked
  PickBy by = PickBy::rmse;
  int rounds = 9;
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

struct Choice {
  Variation variation;
  double ms = 0;               ///< median, the filter included
  double rmse = 0;             ///< to the truth
  double ssim = 0;             ///< 1: the same
  std::optional<double> flip;  ///< of the grey picture; where it decides
};

/// How far off an image is by the figure that decides: RMSE, 1 - SSIM, or FLIP.
double error_of(const Choice& choice, PickBy by);

struct Picked {
  std::vector<Choice> finalists;  ///< by time
  size_t tried = 0;               ///< settings, of which these are the ones that may win
  size_t best = 0;                ///< of these
  std::string truth;              ///< what errors are to: "the truth", or what stood in for it
  std::vector<Skipped> skipped;
};

/// Which of what was tried once (`ms` of one run) are timed in turn: indices, first the one that misses the bound least. The
/// most accurate of those that a budget may turn out to allow, but half of the places are for those that were within it at
/// once: near misses do not crowd them out.
std::vector<size_t> finalists_of(const std::vector<Choice>& tries, const PickOptions& options);

/// Tries every preset of the techniques at full and at half resolution, once; then times those that may win in turn. Where
/// the subject has no truth, errors are to the converged image of the technique that comes nearest to ray-traced truth on
/// the built-in scenes. Where one of the techniques makes an image of the first of two views only, times and errors of all
/// are those of the first view. Throws Error that names the nearest miss where nothing is within the bound.
Picked pick(const Subject& subject, const PickOptions& options, Device& device);

}  // namespace gloam::bench
