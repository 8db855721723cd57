// A technique on each frame of a shot, from files to files: frames are decoded, computed and written at the same time, in bounded
// memory, and a run that was interrupted goes on.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/exr.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// Wall-clock times of a frame's steps, milliseconds.
struct StepTimes {
  double decode = 0, compute = 0, write = 0;
};

/// What is told of a shot while it is worked on: override what is of interest. All but `note` are called one at a time; every one may be
/// called from threads of the run.
class ShotEvents {
 public:
  virtual ~ShotEvents() = default;
  /// A sentence on what was assumed, or on what holds for many frames. From several threads at once.
  virtual void note(const std::string& /*sentence*/) {}
  /// A frame is written.
  virtual void done(int /*frame*/, const StepTimes& /*times*/) {}
  /// A frame is left alone: it is whole, and was made in the same way.
  virtual void skipped(int /*frame*/) {}
  /// The files of a frame are there, and are written again.
  virtual void written_again(int /*frame*/, const std::string& /*why*/) {}
  /// A frame ends with an error, and others go on. `lacks_space`: on the disk.
  virtual void failed(int /*frame*/, const std::string& /*why*/, bool /*lacks_space*/) {}
  /// So many frames in a row lacked space on the disk that no further one is begun.
  virtual void disk_is_full() {}
};

/// From which files to which, and how. Names are patterns, with a place for the frame's number: "shot.####.exr", "shot.%04d.exr".
struct ShotRequest {
  std::vector<std::string> inputs = {};         ///< one pattern, or one for each eye
  std::string output = {};                      ///< the pattern of the files to write
  std::optional<std::vector<int>> frames = {};  ///< their numbers; none: all that are there
  ReadOptions reading = {};
  PlanRequest computing = {};  ///< `outputs`: one technique. With `temporal` each frame goes on from the one before
  RunOptions options = {};
  WriteOptions writing = {.half = true, .half_planes = {}, .keeps_margin = false};
  bool keeps_depth = false;       ///< the frame's depth is written too, and of two eyes the normals
  bool resumes = false;           ///< leaves frames alone that are whole and were made in the same way
  unsigned long long memory = 0;  ///< most memory of the process, bytes; 0: what is available
};

/// How a shot ended.
struct ShotSummary {
  std::vector<int> done, skipped, failed;  ///< numbers of frames
  bool is_disk_full = false;
};

/// Runs. A frame's files are whole or not there, whatever ends the process. A frame that fails is told to `events`; the others go on.
/// `device`: gives the device, called once, on a thread of its own while the first frames are decoded. Throws UsageError for names and
/// settings; Error if no frame can be planned, if one frame takes more memory than allowed, if another process writes frames of this
/// output, and for what all frames would fail for.
ShotSummary run_shot(const ShotRequest& request, const std::function<std::shared_ptr<Device>()>& device,
                     ShotEvents& events);

}  // namespace gloam
