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

/// What takes part, and how it did; ratios are its time over the other's, none where the other takes no part.
struct Racer {
  Variation variation;
  std::unique_ptr<TimedPlan> timed;
  Series ms;
  std::optional<double> to_naive, to_native, to_gather_floor, to_copy_floor, to_hbao_plus;
};

/// All that runs in turn on one frame: what is entered, HBAO+ with 8 x 4 samples, the loops that compute the same, and the
/// floors (docs/benchmarking.md).
class Race {
 public:
  /// `holds`: words for messages on what the frame has. Frame and device must outlive it.
  Race(const Frame& frame, const std::string& holds, double radius, Device& device);
  ~Race();

  /// `racer.variation` says what; the racer must stay where it is. Throws what `gloam::run` throws.
  void enter(Racer& racer);

  /// Fills in the times and ratios of all that was entered. `progress` may be empty.
  void run(int rounds, const std::function<void(int done, int of)>& progress);

  /// Why a baseline took no part, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  class Baselines;
  /// HBAO+ 8 x 4, and what goes with it: only where the frame has what it reads.
  void enter_reference();
  void enter_baselines(const HbaoPlusParams& params);
  std::optional<double> ratio_to(const Series& ms, const std::string& contender) const;
  void add_ratios(Racer& racer) const;

  const Frame& frame_;
  std::string holds_;
  double radius_;
  Device& device_;
  std::vector<std::string> notes_;
  std::vector<Racer*> racers_;
  std::vector<Contender> contenders_;  ///< of the racers, then the others
  Variation reference_variation_;
  Frame plain_;
  std::unique_ptr<TimedPlan> reference_;
  std::unique_ptr<Baselines> baselines_;
  std::map<std::string, Series> series_;
};

}  // namespace gloam::bench
