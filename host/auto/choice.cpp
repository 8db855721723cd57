#include "auto/choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Calls `look` for every combination of options, the empty one first.
template <typename Look>
void for_each_choice(const ChoiceProblem& problem, const Look& look) {
  std::vector<int> options(problem.effects.size(), left_out);
  while (true) {
    look(figures_of(problem, options));
    size_t i = 0;
    for (; i < options.size(); ++i) {
      if (++options[i] < int(problem.effects[i].size())) break;
      options[i] = left_out;
    }
    if (i == options.size()) return;
  }
}

/// Errors that differ by less are taken for equal.
constexpr double least_difference = 1.03;

bool relies_less_on_luck(const Choice& a, const Choice& b) {
  return a.without_luck < b.without_luck || (a.without_luck == b.without_luck && a.ms < b.ms);
}

}  // namespace

Choice figures_of(const ChoiceProblem& problem, const std::vector<int>& options) {
  Choice choice{options, 0, 0, 0};
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

std::optional<Choice> best_within_time(const ChoiceProblem& problem, double ms) {
  double least = std::numeric_limits<double>::infinity();
  for_each_choice(problem, [&](const Choice& choice) {
    if (choice.ms <= ms) least = std::min(least, choice.error);
  });
  std::optional<Choice> best;
  for_each_choice(problem, [&](const Choice& choice) {
    if (choice.ms > ms || choice.error > least * least_difference) return;
    if (!best || relies_less_on_luck(choice, *best)) best = choice;
  });
  return best;
}

std::optional<Choice> fastest_within_error(const ChoiceProblem& problem, double error) {
  std::optional<Choice> fastest;
  for_each_choice(problem, [&](const Choice& choice) {
    if (choice.error > error) return;
    if (!fastest || choice.ms < fastest->ms || (choice.ms == fastest->ms && choice.error < fastest->error))
      fastest = choice;
  });
  return fastest;
}

Choice most_accurate(const ChoiceProblem& problem) {
  return *best_within_time(problem, std::numeric_limits<double>::infinity());
}

}  // namespace gloam
