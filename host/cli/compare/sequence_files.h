// The files of a comparison of sequences: test, truth and --frame, each a pattern or, but for the test, one file for all frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/compare/sequence.h"
#include "cli/compare/sides.h"
#include "cli/flags/notes.h"
#include "cli/shot/shot.h"
#include "gloam/flicker.h"

namespace gloam::cli {

class ComparedShot {
 public:
  /// Throws UsageError for patterns of another form, and Error for frames that are missing.
  ComparedShot(const CompareFlags& flags, const FrameChoice& choice);

  const std::vector<SequenceFrame>& frames() const { return shot_.frames(); }
  std::vector<int> numbers() const { return shot_.numbers(); }
  /// The flags of a comparison of one frame.
  CompareFlags flags_of(const SequenceFrame& frame) const;
  /// The truth and --frame, where they are one file for all frames.
  std::vector<std::string> files_of_all_frames() const;
  /// How the frame is read: values as in the file.
  ReadOptions options_of(const SequenceFrame& frame) const;
  /// Throws UsageError if an output is an input or another output, and Error if one cannot be written. `movie`: --differences.
  void check_outputs(const std::string& movie) const;

 private:
  CompareFlags flags_;
  std::optional<size_t> reference_, frame_;  ///< which of the patterns; none for one file
  ShotFiles shot_;
};

/// One frame of a comparison, with all its pixels.
struct ComparedFrame {
  CompareFlags flags;
  Side test, reference;
  ViewPairs pairs;
  PlanePair planes;
  Overlap overlap;
  double exposure = 0;
  bool is_background_known = false;
  std::vector<SequenceFramePlanes> views;
  std::string surfaces_from;  ///< whose depth, cameras and motion: "--frame", "the test", "the truth"; empty: nobody's
};

/// Runs `work` on every frame, with progress; an error names the frame.
template <typename Work>
void for_each_frame(const ComparedShot& shot, const Work& work) {
  const auto progress = progress_bar();
  const int count = int(shot.frames().size());
  int done = 0;
  for (const SequenceFrame& frame : shot.frames()) {
    try {
      work(frame);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      throw Error("frame {}: {}", frame.number, error.what());
    }
    if (progress) progress(++done, count);
  }
}

/// Opens and decodes a frame.
ComparedFrame read_compared_frame(const ComparedShot& shot, const SequenceFrame& frame);

}  // namespace gloam::cli
