#include "planner/figures.h"

#include <algorithm>

namespace gloam {
namespace {

bool is_faster(const Figures& a, const Figures& b) { return a.ms < b.ms || (a.ms == b.ms && a.error < b.error); }

bool is_nearer(const Figures& a, const Figures& b) { return a.error < b.error || (a.error == b.error && a.ms < b.ms); }

}  // namespace

bool is_within(const Figures& figures, const Goal& goal) {
  return goal.ms ? figures.ms <= *goal.ms : figures.error + figures.uncertainty <= *goal.error;
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
  std::optional<size_t> best;
  for (size_t i = 0; i < all.size(); ++i)
    if (is_within(all[i], goal) && (!best || is_better(all[i], all[*best], goal))) best = i;
  return best;
}

size_t nearest_miss(const std::vector<Figures>& all, const Goal& goal) {
  const auto is_less = [&](const Figures& a, const Figures& b) { return misses_less(a, b, goal); };
  return size_t(std::min_element(all.begin(), all.end(), is_less) - all.begin());
}

}  // namespace gloam
