#include "auto/choice.h"

#include <algorithm>

#include "base/lists.h"
#include "planner/reason.h"

namespace gloam {
namespace {

std::vector<UsedPlane> used_by(const ChoiceProblem& problem, const std::vector<int>& options) {
  std::vector<UsedPlane> planes;
  for (size_t i = 0; i < options.size(); ++i) {
    if (options[i] == left_out) continue;
    const auto& made = problem.effects[i][size_t(options[i])].makes;
    planes.insert(planes.end(), made.begin(), made.end());
  }
  return problem.uses ? used_among(std::move(planes), problem.uses) : planes;
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

std::vector<Figures> figures_of_all(const ChoiceProblem& problem) {
  size_t count = 1;
  for (const auto& effect : problem.effects) count *= effect.size() + 1;
  std::vector<Figures> all;
  for (size_t i = 0; i < count; ++i) {
    const Choice choice = figures_of(problem, options_of(problem, i));
    all.push_back({choice.ms, choice.error, choice.uncertainty});
  }
  return all;
}

}  // namespace

std::vector<UsedPlane> used_among(std::vector<UsedPlane> planes, const UsedAmong& uses) {
  std::vector<std::string> names;
  for (const UsedPlane& plane : planes) names.push_back(plane.plane);
  std::sort(names.begin(), names.end());
  const std::vector<std::string> used = uses(names);
  std::erase_if(planes, [&](const UsedPlane& plane) { return !contains(used, plane.plane); });
  return planes;
}

Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options) {
  Choice choice{options, problem.looking_ms, 0, 0};
  for (size_t i = 0; i < options.size(); ++i)
    if (options[i] != left_out) choice.ms += problem.effects[i][size_t(options[i])].ms;
  const ExpectedSquare expected = expected_square(problem.model, used_by(problem, options));
  choice.error = expected.error();
  choice.uncertainty = expected.uncertainty();
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
