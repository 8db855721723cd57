// What holds for every step of a shot's frames, whatever is computed.
#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cli/shot/report.h"
#include "cli/shot/shot.h"

namespace gloam::cli {

/// Runs the steps of frames: an error of one frame ends this frame alone, and is told. Threads may share it.
class ShotSteps {
 public:
  /// `stop`: called if no further frame shall begin.
  ShotSteps(const ShotFiles& files, ShotReport& report, std::function<void()> stop)
      : files_(files), report_(report), stop_(std::move(stop)) {}

  /// Runs a step of a frame, by its place in the list. False if it failed, or returned false. `ms`: set to the time it took. `is_told`:
  /// a failure is told; it is not of a frame that is only computed for those that follow.
  bool run(size_t i, double& ms, const std::function<bool()>& step, bool is_told = true);
  /// Adds notes; of many frames each once, whichever file and numbers it names.
  void add_notes(size_t i, const std::vector<std::string>& notes);

 private:
  const ShotFiles& files_;
  ShotReport& report_;
  std::function<void()> stop_;
  std::mutex mutex_;
  std::set<std::string> told_;  ///< notes without their numbers
};

/// Throws Error for a frame whose image has another size than the first one's.
void check_size_in_shot(const FrameFiles& files, const Window& first);

/// Throws Error for a frame that would take more memory than a frame of the shot has.
void check_bytes_in_shot(const FrameFiles& files, unsigned long long bytes, unsigned long long most);

/// Calls `attempt` with frame after frame until one succeeds, which then stands for all. Throws UsageError of the first that does, and
/// Error with that of the first frame if none succeeds.
void first_that_can(const ShotFiles& shot, const std::function<void(const SequenceFrame&)>& attempt);

}  // namespace gloam::cli
