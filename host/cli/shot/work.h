// The work on the frames of a shot.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/outputs.h"
#include "cli/run/steps.h"
#include "cli/shot/report.h"
#include "cli/shot/shot.h"
#include "cli/shot/steps.h"
#include "sequence/frame_making.h"
#include "sequence/history_chain.h"
#include "sequence/turns.h"

namespace gloam::cli {

/// What every frame of a shot has in common.
struct ShotSettings {
  PlanRequest request;               ///< of one that goes on over time, with the planes from which a history is made
  std::vector<std::string> written;  ///< planes, besides those carried
  RunOptions options;
  OutputSettings writing;
  Carried carried;
  ShotOutputs outputs;
  bool resume = false;
  std::string version, contents;       ///< as in FrameMaking
  Window display;                      ///< the image, of one size for all frames
  unsigned long long frame_bytes = 0;  ///< most memory that one frame may take
};

/// Memory that a frame takes from the start of its decoding to the end of its writing, besides what computing takes.
unsigned long long bytes_in_flight(const PlannedFrame& planned);

/// What decides the contents of a frame's file, but for its history.
FrameMaking making_of(const ShotSettings& settings, const FrameFiles& files);

/// Adds the frames that a frame goes on from, in a word. `before`: the word of the frame before; empty where a history begins. Returns the
/// frame's own.
std::string add_history_to(FrameMaking& making, const std::string& before);

/// The first file of a frame that has to be written again, and why; no reason if all may stay.
std::pair<std::string, std::string> first_to_write_again(const FrameOutputs& outputs, const OutputSettings& settings,
                                                         const FrameMaking& making);

/// The steps of a frame, for a `Pipeline`: each tells the report of frames that end with it. An error of one frame ends this
/// frame alone; what all frames would fail for (no device, no memory on it) is thrown.
class ShotWork {
 public:
  /// `device`: opened while the first frames are decoded. `stop`: called if no further frame shall begin.
  ShotWork(const ShotFiles& files, const ShotSettings& settings, const std::vector<Turn>& turns,
           std::future<Device> device, ShotReport& report, std::function<void()> stop);

  bool decode(size_t i);
  bool compute(size_t i);
  bool write(size_t i);

 private:
  /// A frame between its steps.
  struct InFlight {
    std::optional<PlannedFrame> planned;  ///< while it is decoded
    Plan plan;
    Frame frame, result;  ///< as decoded; what is written
    OutputSources sources;
    FrameMaking making;
    StepTimes times;
  };
  const SequenceFrame& frame_at(size_t i) const { return files_.frames()[turns_[i].frame]; }
  FrameOutputs outputs_of(size_t i) const { return settings_.outputs.of(frame_at(i).number); }
  bool open(size_t i, InFlight& flight);
  void compute_planes(size_t i, InFlight& flight);
  /// Adds what the frame before knew, or nothing where a sequence begins. Returns whether it goes on.
  bool take_over(size_t i, InFlight& flight);
  void leave_for_next(size_t i, InFlight& flight);
  bool step(size_t i, double StepTimes::*time, const std::function<bool(InFlight&)>& work);

  const ShotFiles& files_;
  const ShotSettings& settings_;
  const std::vector<Turn>& turns_;
  std::future<Device> starting_;
  std::optional<Device> device_;
  ShotReport& report_;
  ShotSteps steps_;
  std::vector<std::unique_ptr<InFlight>> flights_;
  HistoryChain history_;
  size_t turn_before_ = 0;    ///< the frame computed last
  std::string files_before_;  ///< a word for the files of the frames computed since a history began
  bool gap_noted_ = false;
};

}  // namespace gloam::cli
