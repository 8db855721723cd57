// Which effects to compute, and how well, for a time or an error of the whole picture.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// A way to compute an effect.
struct OptionFigures {
  std::vector<std::string> makes;  ///< planes that the picture takes: {"ao"}
  double ms = 0;                   ///< on the device
  /// RMS error of the picture by this option alone, as a share of the error of a picture without the effect.
  double relative_error = 0;
  double unsigned_error = 0;  ///< the part of it that `ChoiceProblem::loss_with` does not hold
};

/// The options of each effect, and what the picture loses.
struct ChoiceProblem {
  std::vector<std::vector<OptionFigures>> effects;
  /// RMS difference between the picture of these planes alone, sorted by name, and the true picture of everything. Asked for every
  /// combination of options.
  std::function<double(const std::vector<std::string>& planes)> loss_with;
  /// Of each effect: RMS difference between the picture of everything and the one without the effect.
  std::vector<double> loss_without;
};

struct Choice {
  std::vector<int> options;  ///< by effect; `left_out`: the effect is not computed
  double ms = 0;             ///< sum over effects
  double error = 0;          ///< expected RMS error of the picture
  double without_luck = 0;   ///< the same if errors of different effects never cancelled
};

inline constexpr int left_out = -1;

/// What a choice takes, and the error of its picture: what is left out, and the errors of what is computed, added as squares, since they
/// have different causes.
Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options);

/// The choice of least error within a time. Errors of different effects may cancel, which is luck in part: of choices whose errors
/// differ by 3 % or less, the one that relies on it least, then the faster. None if even the empty choice takes longer (`ms` below 0).
std::optional<Choice> best_within_time(const ChoiceProblem& problem, double ms);

/// The fastest choice within an error; none if no choice is expected to reach it.
std::optional<Choice> fastest_within_error(const ChoiceProblem& problem, double error);

/// The choice of least error, whatever it takes.
Choice most_accurate(const ChoiceProblem& problem);

}  // namespace gloam
