#include "auto/choice.h"

#include <algorithm>
#include <cmath>

#include "planner/reason.h"

namespace gloam {
namespace {

std::vector<std::string> planes_of(const ChoiceProblem& problem, const std::vector<int>& options) {
  std::vector<std::string> planes;
  for (size_t i = 0; i < options.size(); ++i) {
    if (options[i] == left_out) continue;
    const auto& made = problem.effects[i][size_t(options[i])].makes;
    planes.insert(planes.end(), made.begin(), made.end());
  }
  std::sort(planes.begin(), planes.end());
  return planes;
}

/// The options of a choice by its number among all: 0 is the empty one.
std::vector<int> options_of(const ChoiceProblem& problem, size_t number) {
  std::vector<int> options;
  for (const auto& effect : problem.effects) {
    const size_t ways = effect.size() + 1;
    options.push_back(int(number % ways) - 1);
    number /= ways;
  }
  return options;
}

/// Of every choice. How far its error may be off is told by what it would be without luck.
std::vector<Figures> figures_of_all(const ChoiceProblem& problem) {
  size_t count = 1;
  for (const auto& effect : problem.effects) count *= effect.size() + 1;
  std::vector<Figures> all;
  for (size_t i = 0; i < count; ++i) {
    const Choice choice = figures_of(problem, options_of(problem, i));
    all.push_back({choice.ms, choice.error, choice.without_luck});
  }
  return all;
}

}  // namespace

Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options) {
  Choice choice{options, problem.looking_ms, 0, 0};
  double squares = std::pow(problem.loss_with(planes_of(problem, options)), 2), squares_of_each = 0;
  for (size_t i = 0; i < options.size(); ++i) {
    const double without = problem.loss_without[i];
    if (options[i] == left_out) {
      squares_of_each += without * without;
      continue;
    }
    const OptionFigures& option = problem.effects[i][size_t(options[i])];
    choice.ms += option.ms;
    squares += std::pow(option.unsigned_error * without, 2);
    squares_of_each += std::pow(option.relative_error * without, 2);
  }
  choice.error = std::sqrt(squares);
  choice.without_luck = std::sqrt(squares_of_each);
  return choice;
}

std::optional<Choice> best_within(const ChoiceProblem& problem, const Goal& goal) {
  const std::optional<size_t> best = best_within(figures_of_all(problem), goal);
  return best ? std::optional(figures_of(problem, options_of(problem, *best))) : std::nullopt;
}

Choice nearest_miss(const ChoiceProblem& problem, const Goal& goal) {
  return figures_of(problem, options_of(problem, nearest_miss(figures_of_all(problem), goal)));
}

std::string why_chosen(const ChoiceProblem& problem, const Choice& choice, const Goal& goal,
                       const std::function<std::string(const std::vector<int>& options)>& label) {
  size_t number = 0;
  for (size_t i = choice.options.size(); i-- > 0;)
    number = number * (problem.effects[i].size() + 1) + size_t(choice.options[i] + 1);
  return why_chosen(figures_of_all(problem), number, goal,
                    {.label = [&](size_t i) { return label(options_of(problem, i)); }, .error = "expected RMSE"});
}

}  // namespace gloam
