// Which effects to compute, and how well, for a time or an error of the whole picture.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/figures.h"
#include "planner/picture_model.h"

namespace gloam {

/// A way to compute an effect.
struct OptionFigures {
  std::vector<UsedPlane> makes;  ///< planes that the picture takes
  double ms = 0;                 ///< on the device
};

/// Of planes that options make, sorted, those that the picture uses (gloam/composition.h).
using UsedAmong = std::function<std::vector<std::string>(const std::vector<std::string>& made)>;
std::vector<UsedPlane> used_among(std::vector<UsedPlane> planes, const UsedAmong& uses);

/// The options of each effect, and what the picture gains by them.
struct ChoiceProblem {
  std::vector<std::vector<OptionFigures>> effects;
  PictureModel model;
  UsedAmong uses;         ///< null: all planes
  double looking_ms = 0;  ///< what looking has taken, whatever is chosen
};

struct Choice {
  std::vector<int> options;  ///< by effect; `left_out`: the effect is not computed
  double ms = 0;             ///< sum over effects, with looking
  double error = 0;          ///< expected RMS error of the picture
  double uncertainty = 0;    ///< standard deviation of that
};

inline constexpr int left_out = -1;

/// What a choice takes, and the error that is expected of its picture.
Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options);

/// Of all choices the one that the goal asks for (`planner/figures.h`); none if no choice is within it.
std::optional<Choice> best_within(const ChoiceProblem& problem, const Goal& goal);

/// The choice that misses the goal least.
Choice nearest_miss(const ChoiceProblem& problem, const Goal& goal);

/// Why a choice is the one for the goal (`planner/reason.h`). `label`: of the options of a choice.
std::string why_chosen(const ChoiceProblem& problem, const Choice& choice, const Goal& goal,
                       const std::function<std::string(const std::vector<int>& options)>& label);

}  // namespace gloam
