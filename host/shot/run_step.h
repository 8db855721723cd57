// gloam run on the frames of a shot: one technique, written with what its files carry over.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shot/history.h"
#include "shot/outputs.h"
#include "shot/shot_run.h"

namespace gloam {

/// What every frame of a shot has in common.
struct RunSettings {
  PlanRequest request;  ///< temporal: each frame goes on from the one before
  RunOptions options;
  ShotOutputs outputs;
  OutputSettings writing;
  Carried carried;
  std::string contents;                      ///< as FrameStep::settings_of
  std::function<void(Frame&)> as_read = {};  ///< changes a frame as it was read, if set
};

/// Plans the first frame that can be planned, which stands for all; one output, unless some are chosen. Throws UsageError for settings
/// that no frame accepts, and Error if no frame can be planned.
PlannedFrame first_planned(const SequenceFiles& shot, const RunSettings& settings);

class RunStep : public FrameStep {
 public:
  /// `first`: as `first_planned` has it. All that is given has to live as long as the step.
  RunStep(const SequenceFiles& shot, const RunSettings& settings, PlannedFrame first, ShotEvents& events);

  /// Throws Error if one frame takes more than the limit; `ways_out`: advice for less, in words.
  ShotMemory memory(const MemoryLimit& limit, const std::string& ways_out) const;
  Window size() const { return first_.files.files().front().display(); }
  /// The planes that are written.
  const std::vector<std::string>& written() const { return written_; }
  /// Opens the device and compiles, while the first frames are decoded.
  void start(std::function<std::shared_ptr<Device>()> open);

  std::vector<ShotOutput> outputs() const override;
  std::string settings_of(const SequenceFrame& frame, const FrameFiles& files) override;
  void get_ready() override {
    device_ = starting_.get();
    ready_device_ = device_.get();
  }
  std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) override;

 private:
  class Work;

  const SequenceFiles& shot_;
  RunSettings settings_;
  ShotEvents& events_;
  PlannedFrame first_;
  std::vector<std::string> written_;
  std::future<std::shared_ptr<Device>> starting_;
  std::shared_ptr<Device> device_;
  std::atomic<Device*> ready_device_ = nullptr;  ///< the same, for those that decode
  ShotNotes notes_;
  ShotHistory history_;
  bool is_gap_noted_ = false;
};

}  // namespace gloam
