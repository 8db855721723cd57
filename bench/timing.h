// Times that travel: all contenders run in turn, and ratios are made within a round.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/statistics.h"
#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::bench {

/// Milliseconds, one per round.
using Series = std::vector<double>;

/// One way to compute something; gives milliseconds.
struct Contender {
  std::string name;
  std::function<double()> run;
};

/// Runs all in turn, `rounds` times, so that what else the machine does falls on all alike. `progress` is told of single
/// runs, and may be empty.
std::vector<Series> interleaved(const std::vector<Contender>& contenders, int rounds,
                                const std::function<void(int done, int of)>& progress = {});

/// Median of the rounds' ratios a / b: both of a round saw the same machine.
double ratio(const Series& a, const Series& b);

/// A plan as a contender, with the time of each pass.
class TimedPlan {
 public:
  /// Compiles and runs it once. Throws what `gloam::run` throws. Frame and device must outlive it.
  TimedPlan(Plan plan, const Frame& frame, Device& device, const RunOptions& options = {});

  /// The sum over passes and views, by the events of the device, when the device is warm.
  double run();

  /// Of the last run, the sum over the passes on the first view.
  double first_view_ms() const { return first_view_ms_; }

  struct Pass {
    std::string name;                        ///< "hbao+/estimate"
    Series ms;                               ///< one per call of `run`, the sum over views
    std::map<std::string, Series> of_views;  ///< the same by the view's name, of those that it runs on
  };
  const std::vector<Pass>& passes() const { return passes_; }
  const Plan& plan() const { return plan_; }
  int lanes() const { return lanes_; }

 private:
  Plan plan_;
  const Frame& frame_;
  Device& device_;
  RunOptions options_;
  std::vector<Pass> passes_;
  double first_view_ms_ = 0;
  int lanes_ = 1;
};

}  // namespace gloam::bench
