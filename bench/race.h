// Techniques, baselines and floors on one frame, in turn.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/estimate.h"
#include "bench/plans.h"
#include "bench/timing.h"

namespace gloam::bench {

class Naive;

/// A part of a plan's time.
struct Share {
  std::string what;  ///< "gathers", "arithmetic of the estimate" (`split_estimate`), or a pass: "bilateral/horizontal"
  double share = 0;  ///< of 1
};

/// The time of a technique's own passes in two: what its gathers take alone (`gathers`: over all of it) and the rest. In one
/// where the gathers alone take longer: then they are no part of it.
std::vector<Share> split_estimate(double ms, double gathers);

/// A part of a plan, and the naive kernels that compute the same.
struct AgainstNaive {
  std::string part;  ///< "estimate", "filter" or "both"
  Series ms, naive_ms;
  double ratio = 0;
  /// Absolute, between what the two have made up to here, mean and greatest over all pixels; none for the filter alone.
  std::optional<double> mean_difference, greatest_difference;
};

/// What takes part, and how it did; ratios are its time over the other's, none where the other takes no part. Of a
/// technique that needs two views and makes an image of the first, `to_hbao_plus` is to HBAO+ on the first.
struct Racer {
  Variation variation;
  std::unique_ptr<TimedPlan> timed;
  std::unique_ptr<TimedPlan> gathers;  ///< the same without its filter, adding up what it reads and nothing else
  Series ms, own_floor_ms;             ///< of the whole plan; of the technique's own passes in `gathers`
  std::optional<double> to_native, to_gather_floor, to_copy_floor, to_hbao_plus;
  double to_own_floor = 0;
  std::optional<double> copy_floor_ms;      ///< of the run that `to_copy_floor` was made with
  std::vector<AgainstNaive> against_naive;  ///< empty where no naive kernels compute the same
  std::vector<Share> spent_on;              ///< adds up to 1
};

/// All that runs in turn on one frame: what is entered, and after every few of it HBAO+ with 8 x 4 samples and the floors
/// of the device; loops that compute the same after what they are compared with (docs/benchmarking.md).
class Race {
 public:
  /// `holds`: words for messages on what the frame has. Frame and device must outlive it.
  Race(const Frame& frame, const std::string& holds, double radius, Device& device);
  ~Race();

  /// `racer.variation` says what; the racer must stay where it is until `run` is done. Throws what `gloam::run` throws, and
  /// has not entered it then.
  void enter(Racer& racer);

  /// Fills in the times and ratios of all that was entered. `progress` is told of single runs, and may be empty.
  void run(int rounds, const std::function<void(int done, int of)>& progress);

  /// Why a baseline took no part, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  class Baselines;
  /// One view's depth and normals on the device.
  struct Plain;
  Plain& plain();
  /// HBAO+ 8 x 4, and what goes with it: only where the frame has what it reads.
  void enter_reference();
  void enter_baselines(const HbaoPlusParams& params);
  /// Naive kernels, where there are some that compute what the racer does.
  void enter_naive(size_t index);
  /// Some racers, and after them what they are compared with.
  void add_group(size_t first, std::vector<Contender>& contenders);
  void add_ratios(size_t index);
  void add_naive_ratios(size_t index);

  const Frame& frame_;
  std::string holds_;
  double radius_;
  Device& device_;
  std::vector<std::string> notes_;
  std::vector<Racer*> racers_;
  std::vector<Contender> common_;  ///< what every racer is compared with, beside the reference
  std::vector<Contender> loops_;   ///< native: what computes the same is
  Variation reference_variation_;
  std::unique_ptr<Plain> plain_;
  std::unique_ptr<TimedPlan> reference_;
  std::unique_ptr<Baselines> baselines_;
  std::vector<std::unique_ptr<Naive>> naives_;         ///< by racer; null: none
  std::vector<std::map<std::string, Series>> series_;  ///< by group, by name
  std::vector<Series> first_view_;                     ///< by group: the reference on the first view alone
};

}  // namespace gloam::bench
