// The best setting for one frame and device, by measurement.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/measurement.h"

namespace gloam::bench {

/// The figure that decides which image is nearer to the truth.
enum class PickBy { rmse, ssim, flip, flicker };  // flicker: of sequences
/// "RMSE", "SSIM", "FLIP" or "flicker".
const char* name_of(PickBy by);

struct PickOptions {
  std::vector<const Technique*> techniques;
  std::optional<double> budget;  ///< milliseconds; the most accurate within it is picked
  std::optional<double> error;   ///< bound on the deciding figure; the cheapest setting within it is picked
  PickBy by = PickBy::rmse;
  int rounds = 9;
  /// For trying settings; timing the finalists in turn comes on top of it. None: every setting is tried.
  TimeLimit limit;
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

struct Choice {
  Variation variation;
  double ms = 0;               ///< median, the filter included
  double rmse = 0;             ///< to the truth
  double ssim = 0;             ///< 1: the same; of finalists, and of all tried if it decides
  std::optional<double> flip;  ///< of the picture as displayed; only if it decides
};

/// Error of an image by the deciding figure: RMSE, 1 - SSIM, or FLIP.
double error_of(const Choice& choice, PickBy by);

struct Picked {
  std::vector<Choice> finalists;  ///< sorted by time
  size_t tried = 0;               ///< number of settings tried
  size_t best = 0;                ///< index of the best finalist
  std::string truth;              ///< reference of the errors: "the truth", or its stand-in
  bool has_truth = true;          ///< it is no stand-in
  std::vector<Skipped> skipped;
  /// Settings that were not tried: `why` names a faster one that is too slow already, or says that the time was over.
  std::vector<Skipped> left_out;
};

/// Indices of the settings, tried once (`ms` of one run), to time in turn; first the one that misses the bound least. They are
/// the most accurate ones that a budget may allow after all, but half of the places go to those within it at once: near misses
/// must not crowd them out.
std::vector<size_t> finalists_of(const std::vector<Choice>& tries, const PickOptions& options);

/// Tries the presets of the techniques at full and at half resolution, once, those that are more likely to win first, and leaves out
/// those that cannot win because they take longer than others that are too slow; then times those that may win, in turn. If the
/// subject has no truth, errors are to the converged image of the technique that is nearest to ray-traced truth on the built-in
/// scenes (of effects other than ambient occlusion: of the first technique). If one of the techniques makes an image of only the first of two views, times and errors of all are those of the first
/// view. Throws Error that names the nearest miss if nothing is within the bound.
Picked pick(const Subject& subject, const PickOptions& options, Device& device);

}  // namespace gloam::bench
