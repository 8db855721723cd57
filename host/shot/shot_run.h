// The work on the frames of a shot, whatever is done with them: decoding, computing and writing at the same time, going on from an
// earlier run, and one frame after another for a caller that takes the results.
#pragma once

#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gloam/shot.h"
#include "sequence/frame_locks.h"
#include "sequence/frame_making.h"
#include "sequence/sequence_files.h"
#include "sequence/turns.h"
#include "shot/memory.h"

namespace gloam {

/// A frame whose turn has come.
struct FrameTurn {
  size_t index = 0;  ///< among the turns of the run
  SequenceFrame frame;
  int before = 0;  ///< number of the frame of the turn before
  bool begins = true, is_written = true;
};

/// One frame between its steps. An error ends this frame alone.
class FrameWork {
 public:
  virtual ~FrameWork() = default;
  /// Memory that it takes from the start of decoding to the end of writing, beside what computing takes; 0: not counted.
  virtual unsigned long long bytes() const { return 0; }
  /// Several frames at once, begun in order.
  virtual void decode() = 0;
  /// One frame after another, in order, on the thread that runs.
  virtual void compute() = 0;
  /// Several frames at once.
  virtual void write() {}

  FrameTurn turn;
  FrameMaking making;  ///< how it is made, for its header
};

/// What is written of each frame. `added`: as for `why_again`, of a copy.
struct ShotOutput {
  FramePattern pattern;
  std::string added;
};

/// What is done with every frame.
class FrameStep {
 public:
  virtual ~FrameStep() = default;
  virtual std::vector<ShotOutput> outputs() const { return {}; }
  /// What decides the contents of a frame's file besides the version and the input, in words.
  virtual std::string settings_of(const SequenceFrame& /*frame*/, const FrameFiles& /*files*/) { return ""; }
  /// Called once before the first frame is computed. What it throws ends the run: all frames would fail for it.
  virtual void get_ready() {}
  /// Plans a frame that is open; nothing is decoded yet. Several at once.
  virtual std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) = 0;
};

struct ShotSettings {
  std::string version;         ///< of the program, as in FrameMaking
  bool resumes = false;        ///< leaves frames alone that are whole and were made in the same way
  bool goes_on = false;        ///< each frame from the one before
  size_t warm_up = 0;          ///< the first frames that are computed, and not written; less than there are frames
  std::optional<Window> size;  ///< of the image, which every frame has to have
  ShotMemory memory;
};

class ShotRun {
 public:
  /// Locks the frames of all outputs, removes what killed processes left, and tells of frames that are left alone. Throws Error if
  /// another process has locked one. All that is given has to live as long as the run.
  ShotRun(const SequenceFiles& files, FrameStep& step, const ShotSettings& settings, ShotEvents& events);

  /// All frames. Throws what ends the run; an error of a frame is told.
  void run();

  /// The next frame, computed and not written; null after the last. The one after it is decoded meanwhile. Throws what a frame throws,
  /// and then goes on with the next.
  std::unique_ptr<FrameWork> next();

 private:
  struct Flight {
    std::unique_ptr<FrameWork> work;
    StepTimes times;
  };
  FrameTurn turn_at(size_t i) const;
  FrameMaking making_of(const SequenceFrame& frame, const FrameFiles& files);
  std::vector<Turn> turns();
  std::string why_again(int frame, const FrameMaking& making);
  std::unique_ptr<FrameWork> begin(size_t i);
  std::future<std::unique_ptr<FrameWork>> begin_decoding(size_t i);
  bool attempt(size_t i, double StepTimes::*time, const std::function<bool(Flight&)>& step);
  void fail(const FrameTurn& turn, const std::string& why, bool lacks_space);

  const SequenceFiles& files_;
  FrameStep& step_;
  const ShotSettings settings_;
  ShotEvents& events_;
  const std::vector<ShotOutput> outputs_;
  std::list<FrameLocks> locks_;
  std::vector<Turn> turns_;
  std::vector<Flight> flights_;
  std::mutex telling_;
  size_t without_space_ = 0;  ///< frames in a row
  std::function<void()> stop_;
  bool is_ready_ = false;
  size_t turn_ = 0;                                        ///< of `next`
  std::future<std::unique_ptr<FrameWork>> decoding_ = {};  ///< last: it ends before what it uses
};

/// Tells notes on frames; of many frames each once, whichever file and numbers it names. Threads may share it.
class ShotNotes {
 public:
  ShotNotes(const SequenceFiles& files, ShotEvents& events) : files_(files), events_(events) {}
  void add(const SequenceFrame& frame, const std::vector<std::string>& notes);

 private:
  const SequenceFiles& files_;
  ShotEvents& events_;
  std::mutex mutex_;
  std::set<std::string> told_;  ///< notes without their numbers
};

/// Calls `attempt` with frame after frame until one succeeds, which then stands for all. Throws UsageError of the first that does, and
/// Error with that of the first frame if none succeeds.
void first_that_can(const SequenceFiles& shot, const std::function<void(const SequenceFrame&)>& attempt);

}  // namespace gloam
