// Which of many settings is the best within a bound: each is tried once, timed again where one slow reading may have cost it its place,
// and the best few are timed in turn. All in a limited time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/words.h"
#include "measure/measurement.h"
#include "planner/figures.h"

namespace gloam::bench {

/// The figure that decides which image is nearer to the truth.
enum class PickBy { rmse, ssim, flip, flicker };  // flicker: of sequences
/// Their words: "rmse", "ssim", "flip" and "flicker".
extern const Choices<PickBy> pick_figures;
/// "RMSE", "SSIM", "FLIP" or "flicker".
const char* name_of(PickBy by);
/// Of what a goal bounds: "1 - SSIM" for SSIM.
const char* name_of_error(PickBy by);

struct PickOptions {
  std::vector<const Technique*> techniques;
  Goal goal;  ///< a time, the filter included, or a bound on the deciding figure
  PickBy by = PickBy::rmse;
  int rounds = 9;
  /// For everything. None: every setting is tried.
  TimeLimit limit;
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

struct Choice {
  Variation variation;
  double ms = 0;    ///< the filter included: the least of the readings, of finalists the median of the rounds
  double rmse = 0;  ///< to the truth
  std::optional<double> ssim;  ///< 1: the same; of finalists as far as time allows, and of all tried if it decides
  std::optional<double> flip;  ///< of the picture as displayed; only if it decides
};

/// Its time, and its error by the deciding figure: RMSE, 1 - SSIM, or FLIP.
Figures figures_of(const Choice& choice, PickBy by);

/// Readings of a setting's time before its time may cost it its place: other work on the machine makes single ones too long.
constexpr size_t enough_readings = 3;

/// A setting that was tried.
struct Contestant {
  size_t index = 0;              ///< among the settings
  Choice choice;                 ///< its time is the least of the readings
  std::vector<double> readings;  ///< milliseconds
  double seconds = 0;            ///< of the clock, of the last reading
};

/// What a contest asks of the settings, by their index.
struct Trials {
  /// Compiles and runs a setting, measures its error, and times it once. None: it cannot run.
  std::function<std::optional<Choice>(size_t)> attempt;
  /// Times one that was tried, milliseconds.
  std::function<double(size_t)> time;
};

struct ContestResult {
  std::vector<Contestant> finalists;  ///< sorted by time, which is the median of the rounds
  std::optional<size_t> best;         ///< of the finalists; none: nothing is within the bound
  std::vector<Contestant> others;     ///< tried, and no finalists
  size_t tried = 0;                   ///< number of settings tried
  /// Settings that were not tried: `why` names a faster one that is too slow already, or says that the time was over. Also those whose
  /// time decides against them, and was over before they were timed often enough.
  std::vector<Skipped> left_out;
};

/// Why settings are left out for want of time.
inline const std::string time_was_over = "the time was over";

/// Tries the settings once, those that are more likely to win first; times those again, in turn, which a shorter time could make win, or
/// that stand for more expensive ones; leaves out what cannot win because a cheaper preset is too slow already; then times the best few
/// in turn. No setting falls away by fewer than `enough_readings` readings, unless the time is over.
ContestResult hold_contest(const std::vector<Variation>& all, const PickOptions& options, const Trials& trials);

/// Indices of the entries to time in turn; first the one that misses the bound least. They are the most accurate ones that a budget may
/// allow after all, but half of the places go to those within it at once: near misses must not crowd them out.
std::vector<size_t> finalists_of(const std::vector<Choice>& tries, const PickOptions& options);

}  // namespace gloam::bench
