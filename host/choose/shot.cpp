#include "choose/shot.h"

#include <algorithm>

#include "base/statistics.h"
#include "gloam/error.h"
#include "planner/reason.h"

namespace gloam::bench {
namespace {

/// The time of a frame, and RMSE, 1 - SSIM or flicker.
Figures figures_of_row(const SequenceRow& row, PickBy by) {
  const double ms = median(row.ms);
  if (by == PickBy::flicker) return {ms, row.flicker.flicker().value_or(1)};
  return {ms, by == PickBy::ssim ? 1 - row.ssim : row.rmse};
}

}  // namespace

std::string rank(std::vector<SequenceRow>& rows, const PickOptions& options) {
  std::sort(rows.begin(), rows.end(), [&](const SequenceRow& a, const SequenceRow& b) {
    return ranks_before(figures_of_row(a, options.by), figures_of_row(b, options.by), options.goal);
  });
  std::vector<Figures> all;
  for (const SequenceRow& row : rows) all.push_back(figures_of_row(row, options.by));
  const OptionWords words{.label = [&](size_t i) { return option_of(rows[i].variation).label(); },
                          .error = name_of_error(options.by)};
  if (!is_within(all.front(), options.goal)) throw Error("{}", why_none(all, options.goal, words));
  return why_chosen(all, 0, options.goal, words);
}

}  // namespace gloam::bench
