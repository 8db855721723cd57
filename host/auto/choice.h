// Which effects to compute, and how well, for a time or an error of the whole picture.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/figures.h"

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
  double looking_ms = 0;  ///< what looking has taken, whatever is chosen
};

struct Choice {
  std::vector<int> options;  ///< by effect; `left_out`: the effect is not computed
  double ms = 0;             ///< sum over effects, with looking
  double error = 0;          ///< expected RMS error of the picture
  double without_luck = 0;   ///< the same if errors of different effects never cancelled
};

inline constexpr int left_out = -1;

/// What a choice takes, and the error of its picture: what is left out, and the errors of what is computed, added as squares, since they
/// have different causes.
Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options);

/// Of all choices the one that the goal asks for (`planner/figures.h`); none if no choice is within it. Errors of different effects may
/// cancel, which is luck in part: a choice is the surer, the less it relies on that.
std::optional<Choice> best_within(const ChoiceProblem& problem, const Goal& goal);

/// The choice that misses the goal least.
Choice nearest_miss(const ChoiceProblem& problem, const Goal& goal);

/// Why a choice is the one for the goal (`planner/reason.h`). `label`: of the options of a choice.
std::string why_chosen(const ChoiceProblem& problem, const Choice& choice, const Goal& goal,
                       const std::function<std::string(const std::vector<int>& options)>& label);

}  // namespace gloam
