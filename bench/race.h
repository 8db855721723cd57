// Techniques, baselines and floors on one frame, in turn.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimate.h"
#include "plans.h"
#include "timing.h"

namespace gloam::bench {

/// A part of a plan's time.
struct Share {
  std::string what;  ///< "gathers", "arithmetic of the estimate", or a pass: "bilateral/horizontal"
  double share = 0;  ///< of 1
};

/// What takes part, and how it did; ratios are its time over the other's, none where the other takes no part.
struct Racer {
  Variation variation;
  std::unique_ptr<TimedPlan> timed;
  std::unique_ptr<TimedPlan> gathers;  ///< the same without its filter, adding up what it reads and nothing else
  Series ms, own_floor_ms;             ///< of the whole plan; of the technique's own passes in `gathers`
  std::optional<double> to_naive, to_native, to_gather_floor, to_copy_floor, to_hbao_plus;
  double to_own_floor = 0;
  std::vector<Share> spent_on;  ///< adds up to 1
};

/// All that runs in turn on one frame: what is entered, and after every few of it HBAO+ with 8 x 4 samples and the floors
/// of the device; the loops that compute the same once (docs/benchmarking.md).
class Race {
 public:
  /// `holds`: words for messages on what the frame has. Frame and device must outlive it.
  Race(const Frame& frame, const std::string& holds, double radius, Device& device);
  ~Race();

  /// `racer.variation` says what; the racer must stay where it is. Throws what `gloam::run` throws.
  void enter(Racer& racer);

  /// Fills in the times and ratios of all that was entered. `progress` is told of single runs, and may be empty.
  void run(int rounds, const std::function<void(int done, int of)>& progress);

  /// Why a baseline took no part, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  class Baselines;
  /// HBAO+ 8 x 4, and what goes with it: only where the frame has what it reads.
  void enter_reference();
  void enter_baselines(const HbaoPlusParams& params);
  /// Some racers, and after them what they are compared with.
  void add_group(size_t first, std::vector<Contender>& contenders);
  void add_ratios(size_t index);

  const Frame& frame_;
  std::string holds_;
  double radius_;
  Device& device_;
  std::vector<std::string> notes_;
  std::vector<Racer*> racers_;
  std::vector<Contender> common_;  ///< what every racer is compared with
  std::vector<Contender> loops_;   ///< naive and native: what computes the same is
  Variation reference_variation_;
  Frame plain_;
  std::unique_ptr<TimedPlan> reference_;
  std::unique_ptr<Baselines> baselines_;
  std::vector<std::map<std::string, Series>> series_;  ///< by group, by name
};

}  // namespace gloam::bench
