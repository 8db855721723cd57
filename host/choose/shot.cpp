#include "choose/shot.h"

#include <algorithm>

#include "base/statistics.h"
#include "gloam/error.h"

namespace gloam::bench {
namespace {

/// RMSE, 1 - SSIM or flicker.
double figure_of(const SequenceRow& row, PickBy by) {
  if (by == PickBy::flicker) return row.flicker.flicker().value_or(1);
  return by == PickBy::ssim ? 1 - row.ssim : row.rmse;
}

/// How far a setting misses the bound, as a factor; 1 or less: it is within.
double off(const SequenceRow& row, const PickOptions& options) {
  return options.budget ? median(row.ms) / *options.budget : figure_of(row, options.by) / *options.error;
}

/// The best first: those within the bound before others, and of these the nearest to it.
void sort_by_bound(std::vector<SequenceRow>& rows, const PickOptions& options) {
  std::sort(rows.begin(), rows.end(), [&](const SequenceRow& a, const SequenceRow& b) {
    const double off_a = off(a, options), off_b = off(b, options);
    if ((off_a <= 1) != (off_b <= 1)) return off_a <= 1;
    if (off_a > 1) return off_a < off_b;
    return options.budget ? figure_of(a, options.by) < figure_of(b, options.by) : median(a.ms) < median(b.ms);
  });
}

void check_bound(const std::vector<SequenceRow>& rows, const PickOptions& options) {
  const SequenceRow& best = rows.front();
  if (off(best, options) <= 1) return;
  const std::string name = best.variation.technique->name + " " + best.variation.name();
  if (options.budget)
    throw Error("no setting takes {:g} ms a frame or less; the fastest is {} with {:.2f} ms", *options.budget, name,
                median(best.ms));
  throw Error("no setting has {} {:g} or less; the nearest is {} with {:.4f}",
              options.by == PickBy::ssim ? "1 - SSIM" : name_of(options.by), *options.error, name,
              figure_of(best, options.by));
}

}  // namespace

void rank(std::vector<SequenceRow>& rows, const PickOptions& options) {
  sort_by_bound(rows, options);
  check_bound(rows, options);
}

}  // namespace gloam::bench
