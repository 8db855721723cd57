#include "choose/shot.h"

#include <algorithm>

#include "base/statistics.h"
#include "gloam/error.h"

namespace gloam::bench {
namespace {

/// The time of a frame, and RMSE, 1 - SSIM or flicker.
Figures figures_of_row(const SequenceRow& row, PickBy by) {
  const double ms = median(row.ms);
  if (by == PickBy::flicker) return {ms, row.flicker.flicker().value_or(1)};
  return {ms, by == PickBy::ssim ? 1 - row.ssim : row.rmse};
}

void check_bound(const SequenceRow& best, const PickOptions& options) {
  const Figures figures = figures_of_row(best, options.by);
  if (is_within(figures, options.goal)) return;
  const std::string name = option_of(best.variation).label();
  if (options.goal.ms)
    throw Error("no setting takes {:g} ms a frame or less; the fastest is {} with {:.2f} ms", *options.goal.ms, name,
                figures.ms);
  throw Error("no setting has {} {:g} or less; the nearest is {} with {:.4f}", name_of_error(options.by),
              *options.goal.error, name, figures.error);
}

}  // namespace

void rank(std::vector<SequenceRow>& rows, const PickOptions& options) {
  std::sort(rows.begin(), rows.end(), [&](const SequenceRow& a, const SequenceRow& b) {
    return ranks_before(figures_of_row(a, options.by), figures_of_row(b, options.by), options.goal);
  });
  check_bound(rows.front(), options);
}

}  // namespace gloam::bench
