#include "planner/reason.h"

#include <fmt/format.h>

#include <optional>

#include "planner/goal.h"

namespace gloam {
namespace {

/// Errors in shares of another's are told up to this many times.
constexpr double most_times = 10;

std::optional<size_t> next_faster(const std::vector<Figures>& all, size_t chosen) {
  std::optional<size_t> next;
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i].ms >= all[chosen].ms || all[i].error <= all[chosen].error) continue;
    if (!next || all[i].error < all[*next].error) next = i;
  }
  return next;
}

/// Where nothing that is faster is worse: the most accurate of the others within the goal.
std::optional<size_t> next_best(const std::vector<Figures>& all, size_t chosen, const Goal& goal) {
  std::optional<size_t> next;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i == chosen || !is_within(all[i], goal)) continue;
    if (!next || all[i].error < all[*next].error) next = i;
  }
  return next;
}

std::string errs_more(double error, double than, const OptionWords& words) {
  const double percent = 100 * (error / than - 1);
  if (than > 0 && error < most_times * than) return fmt::format("errs {:.{}f} % more", percent, percent < 9.95 ? 1 : 0);
  return fmt::format("has {} {:.4f}", words.error, error);
}

std::string with_figures(const Figures& figures, const OptionWords& words) {
  return fmt::format("with {:.2f} ms and {} {:.4f}", figures.ms, words.error, figures.error);
}

}  // namespace

std::string why_chosen(const std::vector<Figures>& all, size_t chosen, const Goal& goal, const OptionWords& words) {
  const bool is_met = is_within(all[chosen], goal);
  const std::string bound = bound_in_words(goal, words.error);
  const std::string what = is_met ? fmt::format("the {} {}", goal.ms ? "most accurate" : "fastest", bound)
                                  : fmt::format("nothing is {}, and nearest to it", bound);
  const std::string one = fmt::format("{}: {} {}", what, words.label(chosen), with_figures(all[chosen], words));
  const std::optional<size_t> next = next_faster(all, chosen);
  if (!next) {
    const std::optional<size_t> other = goal.ms && is_met ? next_best(all, chosen, goal) : std::nullopt;
    if (!other) return one + "; nothing faster is known";
    return fmt::format("{}; nothing faster is known, and the next best, {}, takes {:.2f} ms and {}", one,
                       words.label(*other), all[*other].ms, errs_more(all[*other].error, all[chosen].error, words));
  }
  return fmt::format("{}; the next faster, {}, takes {:.2f} ms and {}", one, words.label(*next), all[*next].ms,
                     errs_more(all[*next].error, all[chosen].error, words));
}

std::string why_none(const std::vector<Figures>& all, const Goal& goal, const OptionWords& words) {
  const size_t nearest = nearest_miss(all, goal);
  if (goal.ms)
    return fmt::format("{}: nothing is that fast on this device; the fastest is {} with {:.2f} ms", in_words(goal),
                       words.label(nearest), all[nearest].ms);
  return fmt::format("{}: nothing comes that near to {}; the nearest is {} with {} {:.4f}", in_words(goal), words.truth,
                     words.label(nearest), words.error, all[nearest].error);
}

}  // namespace gloam
