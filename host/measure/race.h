// Techniques, baselines and floors on one frame, in turn.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/estimate.h"
#include "measure/plans.h"
#include "measure/roofline.h"
#include "measure/timing.h"

namespace gloam::bench {

class Baselines;
class Naive;
struct PlainFrame;

using report::AgainstNaive;
using report::Peaks;
using report::RoundRatios;
using report::Share;

/// Splits the time of a technique's own passes into that of its gathers alone (`gathers`: as a share) and the rest. One part if
/// the gathers alone take longer: then they are no part of it.
std::vector<Share> split_estimate(double ms, double gathers);

/// A contender and its results. A ratio is its time over the other's; none if the other takes no part. For a technique that makes
/// an image of only the first of two views, `to_hbao_plus` is to HBAO+ on the first view.
struct Racer {
  Variation variation;
  std::unique_ptr<TimedPlan> timed;
  std::unique_ptr<TimedPlan> gathers;  ///< the plan without its filter; samples only add up what they read. May be null
  Series ms, own_floor_ms;             ///< time of the whole plan; of the technique's own passes in `gathers`
  std::optional<double> to_native, to_gather_floor, to_copy_floor, to_hbao_plus;
  Series cpu_ms;  ///< what the process's threads computed; empty where the device is no CPU
  RoundRatios to_hbao_plus_rounds, to_gather_floor_rounds, to_copy_floor_rounds;
  std::optional<double> to_own_floor;       ///< none without `gathers`
  std::optional<double> copy_floor_ms;      ///< of the run that `to_copy_floor` is to
  std::vector<AgainstNaive> against_naive;  ///< empty if no naive kernels compute the same
  std::vector<Share> spent_on;              ///< adds up to 1; empty without `gathers`
};

/// Runs everything on one frame in turn: the entries, and after every few of them HBAO+ with 8 x 4 samples and the floors of the
/// device; baselines that compute the same run after their entry (docs/benchmarking.md).
class Race {
 public:
  /// `holds`: text for messages about the frame's planes. Frame and device must outlive it.
  Race(const Frame& frame, const std::string& holds, double radius, Device& device);
  ~Race();

  /// Enters `racer.variation`; the racer must keep its address until `run` is done. Throws as `gloam::run` does, and then has not
  /// entered it. `with_floor`: with its own floor.
  void enter(Racer& racer, bool with_floor = true);

  /// Fills in the times and ratios of what was entered since the last call. `progress` is called for single runs, and may be empty.
  void run(const Rounds& rounds, const std::function<void(int done, int of)>& progress, bool with_naive = true);

  /// Measures the own floor of a racer that has run without.
  void add_floor(Racer& racer, int rounds);

  /// What the device reached in the rounds so far; empty where the floors took no part.
  Peaks peaks() const;

  /// Why a baseline took no part, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  PlainFrame& plain();
  /// Enters HBAO+ 8 x 4 and its baselines, if the frame has their inputs.
  void enter_reference();
  void enter_baselines(const HbaoPlusParams& params);
  /// Enters naive kernels that compute the same as a racer, if there are any.
  void enter_naive(size_t index);
  /// Adds some racers, and then their baselines.
  void add_group(size_t first, size_t end, std::vector<Contender>& contenders);
  bool are_narrow(const std::vector<Series>& ms, const std::vector<Contender>& contenders,
                  const std::vector<size_t>& group_of, double narrow) const;
  void add_ratios(size_t index);
  void add_naive_ratios(size_t index);

  const Frame& frame_;
  std::string holds_;
  double radius_;
  Device& device_;
  std::vector<std::string> notes_;
  std::vector<Racer*> racers_;
  std::vector<size_t> groups_;  ///< by racer
  size_t groups_so_far_ = 0;
  bool has_reference_ = false;     ///< `enter_reference` was called
  std::vector<Contender> common_;  ///< compared with every racer, besides the reference
  std::vector<Contender> loops_;   ///< native loops: compared with racers that compute the same
  Variation reference_variation_;
  std::unique_ptr<PlainFrame> plain_;
  std::unique_ptr<TimedPlan> reference_;
  std::unique_ptr<Baselines> baselines_;
  std::vector<std::unique_ptr<Naive>> naives_;         ///< by racer; null: none
  std::vector<std::map<std::string, Series>> series_;  ///< by group, by name
  std::vector<Series> first_view_;                     ///< by group: the reference on the first view alone
  std::vector<std::map<std::string, Series>> cpu_;     ///< by group, by name: what the process's threads computed
};

}  // namespace gloam::bench
