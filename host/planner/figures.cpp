#include "planner/figures.h"

#include <algorithm>
#include <limits>

namespace gloam {
namespace {

/// Expected errors that differ by less are taken for equal.
constexpr double least_difference = 1.03;

bool is_faster(const Figures& a, const Figures& b) { return a.ms < b.ms || (a.ms == b.ms && a.error < b.error); }

bool is_nearer(const Figures& a, const Figures& b) { return a.error < b.error || (a.error == b.error && a.ms < b.ms); }

bool is_surer(const Figures& a, const Figures& b) {
  return a.uncertainty < b.uncertainty || (a.uncertainty == b.uncertainty && a.ms < b.ms);
}

std::optional<size_t> most_accurate_within(const std::vector<Figures>& all, double ms) {
  const bool are_expected = std::any_of(all.begin(), all.end(), [](const Figures& f) { return f.uncertainty > 0; });
  double least = std::numeric_limits<double>::infinity();
  for (const Figures& figures : all)
    if (figures.ms <= ms) least = std::min(least, figures.error);
  std::optional<size_t> best;
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i].ms > ms || all[i].error > least * (are_expected ? least_difference : 1)) continue;
    if (!best || is_surer(all[i], all[*best])) best = i;
  }
  return best;
}

std::optional<size_t> fastest_within(const std::vector<Figures>& all, double error) {
  std::optional<size_t> fastest;
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i].error <= error && (!fastest || is_faster(all[i], all[*fastest]))) fastest = i;
  }
  return fastest;
}

}  // namespace

bool is_within(const Figures& figures, const Goal& goal) {
  return goal.ms ? figures.ms <= *goal.ms : figures.error <= *goal.error;
}

bool is_better(const Figures& a, const Figures& b, const Goal& goal) {
  return goal.ms ? is_nearer(a, b) : is_faster(a, b);
}

bool misses_less(const Figures& a, const Figures& b, const Goal& goal) {
  return goal.ms ? is_faster(a, b) : is_nearer(a, b);
}

bool ranks_before(const Figures& a, const Figures& b, const Goal& goal) {
  const bool is_a_within = is_within(a, goal);
  if (is_a_within != is_within(b, goal)) return is_a_within;
  return is_a_within ? is_better(a, b, goal) : misses_less(a, b, goal);
}

std::optional<size_t> best_within(const std::vector<Figures>& all, const Goal& goal) {
  return goal.ms ? most_accurate_within(all, *goal.ms) : fastest_within(all, *goal.error);
}

size_t nearest_miss(const std::vector<Figures>& all, const Goal& goal) {
  if (goal.error) return most_accurate_within(all, std::numeric_limits<double>::infinity()).value_or(0);
  const auto is_less = [&](const Figures& a, const Figures& b) { return misses_less(a, b, goal); };
  return size_t(std::min_element(all.begin(), all.end(), is_less) - all.begin());
}

}  // namespace gloam
