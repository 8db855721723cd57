// The files of a comparison of sequences: test, truth and the frame, each a pattern or, but for the test, one file for all frames.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "comparison/sides.h"
#include "gloam/error.h"
#include "gloam/flicker.h"
#include "sequence/sequence_files.h"

namespace gloam::comparison {

class ComparedShot {
 public:
  /// `options`: how the test is read; values stay as in the file. Throws UsageError for patterns of another form, and Error for frames that
  /// are missing. Appends to `notes` what is assumed.
  ComparedShot(const ComparedFiles& files, const ReadOptions& options, const FrameChoice& choice,
               std::vector<std::string>& notes);

  const SequenceFiles& shot() const { return shot_; }
  /// The files of one frame.
  ComparedFiles files_of(const SequenceFrame& frame) const;
  /// The truth and the frame, where they are one file for all frames.
  std::vector<std::string> files_of_all_frames() const;
  /// How the frame is read: values as in the file.
  ReadOptions options_of(const SequenceFrame& frame) const;
  /// Peak memory of a comparison with the truth, bytes: two frames of each side, and what measuring and drawing one takes.
  unsigned long long bytes() const;

 private:
  ComparedFiles files_;
  std::optional<size_t> reference_, frame_;  ///< which of the patterns; none for one file
  SequenceFiles shot_;
};

/// One frame of a comparison, with all its pixels.
struct ComparedFrame {
  ComparedFiles files;
  Side test, reference;
  ViewPairs pairs;
  PlanePair planes;
  Overlap overlap;
  double exposure = 0;
  bool is_background_known = false;
  std::vector<SequenceFramePlanes> views;
  std::string surfaces_from;  ///< whose depth, cameras and motion: the option, "the test", "the truth"; empty: nobody's
};

/// Is told how many frames are done.
using FrameProgress = std::function<void(int done, int of)>;

/// Runs `work` on every frame; an error names the frame.
template <typename Work>
void for_each_frame(const ComparedShot& compared, const FrameProgress& progress, const Work& work) {
  const std::vector<SequenceFrame>& frames = compared.shot().frames();
  int done = 0;
  for (const SequenceFrame& frame : frames) {
    try {
      work(frame);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      throw Error("frame {}: {}", frame.number, error.what());
    }
    if (progress) progress(++done, int(frames.size()));
  }
}

/// Opens and decodes a frame. Appends to `notes` what is assumed.
ComparedFrame read_compared_frame(const ComparedShot& shot, const SequenceFrame& frame,
                                  std::vector<std::string>& notes);

}  // namespace gloam::comparison
