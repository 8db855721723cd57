// What options take and err, and which of them a goal asks for.
#pragma once

#include <optional>
#include <vector>

#include "gloam/goal.h"

namespace gloam {

/// Of an option, or of a combination of options.
struct Figures {
  double ms = 0;           ///< on the device
  double error = 0;        ///< by the figure that the goal bounds
  double uncertainty = 0;  ///< standard deviation of an error that is expected; 0: it was measured
};

/// A bound on the error is kept if the error is expected to be within it by its standard deviation.
bool is_within(const Figures& figures, const Goal& goal);

/// Whether the first of two is the better one within the goal: nearer to the truth for a time, faster for an error. Of equals, by the other
/// figure.
bool is_better(const Figures& a, const Figures& b, const Goal& goal);

/// Whether the first of two misses the goal by less: faster for a time, nearer to the truth for an error. Of equals, by the other figure.
bool misses_less(const Figures& a, const Figures& b, const Goal& goal);

/// The order of a ranking: what is within the goal before all else, the better one first; then what misses it, by how far.
bool ranks_before(const Figures& a, const Figures& b, const Goal& goal);

/// The most accurate within a time, or the fastest within an error; none if nothing is within the goal.
std::optional<size_t> best_within(const std::vector<Figures>& all, const Goal& goal);

/// What misses the goal least: the fastest, or the most accurate. There is one at least.
size_t nearest_miss(const std::vector<Figures>& all, const Goal& goal);

}  // namespace gloam
