// Times that can be compared between machines: contenders run in turn, and ratios are taken within a round.
#pragma once

#include <functional>
#include <map>
#include <optional>
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

/// One way to compute something; returns milliseconds.
struct Contender {
  std::string name;
  std::function<double()> run;
  /// What the process's threads computed in the last run; empty, or without a value, where that is not known.
  std::function<std::optional<double>()> cpu_ms = {};
};

/// The same, which also keeps what the process's threads computed in each run in `cpu`.
Contender keeping_cpu_time(Contender contender, Series& cpu);

/// When rounds end.
struct Rounds {
  int fewest = 9, most = 9;
  std::function<bool()> is_over = {};  ///< whether the time for them is over; then even one round is enough
  /// Half the width of the interval of each ratio, relative to the ratio, at which no more rounds are needed (intervals.h); 0: none.
  double narrow = 0;
};

/// Runs all contenders in turn, so that other load on the machine affects all alike. After `fewest` rounds `is_enough` may end them.
/// `progress` is called for single runs, and may be empty.
std::vector<Series> interleaved(const std::vector<Contender>& contenders, const Rounds& rounds,
                                const std::function<bool(const std::vector<Series>&)>& is_enough,
                                const std::function<void(int done, int of)>& progress = {});

/// The same with a fixed number of rounds.
std::vector<Series> interleaved(const std::vector<Contender>& contenders, int rounds,
                                const std::function<void(int done, int of)>& progress = {});

/// Median of the rounds' ratios a / b: both times of a round are from the same state of the machine.
double ratio(const Series& a, const Series& b);

/// A plan as a contender, with the time of each pass.
class TimedPlan {
 public:
  /// Compiles and runs the plan once. Throws as `gloam::run` does. Frame and device must outlive it.
  TimedPlan(Plan plan, const Frame& frame, Device& device, const RunOptions& options = {});

  /// Runs the plan once the device is warm; returns the sum over passes and views, by the device's events.
  double run();

  /// Sum over the passes on the first view in the last run.
  double first_view_ms() const { return first_view_ms_; }

  /// What the process's threads computed in each call of `run`; empty where the device is no CPU.
  const Series& cpu_ms() const { return cpu_ms_; }
  /// The same on the first view, in the last run.
  double first_view_cpu_ms() const { return first_view_cpu_ms_; }

  struct Pass {
    std::string name;                        ///< "hbao+/estimate"
    Series ms;                               ///< one per call of `run`, the sum over views
    std::map<std::string, Series> of_views;  ///< by the name of each view that it runs on
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
  double first_view_ms_ = 0, first_view_cpu_ms_ = 0;
  Series cpu_ms_;
  int lanes_ = 1;
};

}  // namespace gloam::bench
