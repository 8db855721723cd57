// The files of a sequence's frames, and how each is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/camera_list.h"
#include "gloam/frame_files.h"
#include "gloam/frame_pattern.h"
#include "sequence/frame_list.h"

namespace gloam {

class SequenceFiles {
 public:
  /// `inputs`: one pattern, or one for each eye. `options.camera_file` may be a pattern, too, or a list of cameras (camera_list.h). Appends
  /// a sentence to `notes` for frames that are left out or held. Throws UsageError and Error as `list_frames` and `CameraList` do.
  SequenceFiles(std::vector<FramePattern> inputs, const ReadOptions& options, const FrameChoice& choice,
                std::vector<std::string>& notes);

  const std::vector<FramePattern>& inputs() const { return inputs_; }
  const std::vector<SequenceFrame>& frames() const { return frames_; }
  std::vector<int> numbers() const;
  /// "shot.####.exr", or both names.
  std::string name() const;

  /// The EXR files of a frame.
  std::vector<std::string> paths_of(const SequenceFrame& frame) const;
  /// The camera file of a frame; empty if none is named, or one holds the cameras of all frames.
  std::string camera_of(const SequenceFrame& frame) const;
  /// Whether one file lists the cameras in the order of the frames, without their numbers.
  bool cameras_are_in_order() const { return camera_list_ && camera_list_->is_in_order(); }
  /// How a frame is read.
  ReadOptions options_for(const SequenceFrame& frame) const;
  FrameFiles open(const SequenceFrame& frame) const { return FrameFiles(paths_of(frame), options_for(frame)); }

 private:
  /// Of all files that may be read, so that no output is one of them.
  void tell_ledger() const;

  std::vector<FramePattern> inputs_;
  std::vector<SequenceFrame> frames_;
  ReadOptions options_;
  std::optional<FramePattern> cameras_;
  std::optional<CameraList> camera_list_;
};

}  // namespace gloam
