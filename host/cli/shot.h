// A shot: frames whose files are named by patterns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/camera_list.h"
#include "cli/run_command.h"
#include "gloam/frame_files.h"
#include "gloam/frame_pattern.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

/// The files of a shot's frames, and how each is read.
class ShotFiles {
 public:
  /// Throws UsageError and Error as `list_frames` and `CameraList` do, and UsageError for one input of two that is no pattern.
  ShotFiles(const FrameArguments& inputs, const FrameFlags& flags, const FrameChoice& choice);
  /// Of any number of patterns. Throws as above.
  ShotFiles(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice);

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
  std::vector<FramePattern> inputs_;
  std::vector<SequenceFrame> frames_;
  ReadOptions options_;
  std::optional<FramePattern> cameras_;
  std::optional<CameraList> camera_list_;
};

/// Throws UsageError for outputs that are patterns, and for a flag of shots, with one frame. `flag`: empty if none is given.
void check_no_shot(const FrameArguments& frame, const std::vector<NamedPath>& outputs, const std::string& flag);

/// Names of outputs with their flags.
using NamedPatterns = std::vector<std::pair<std::string, FramePattern>>;

/// Throws UsageError if a frame's output is also an input of a frame or another output, and Error if it cannot be written.
void check_outputs(const NamedPatterns& patterns, const ShotFiles& shot, const std::vector<NamedPath>& other_outputs);

}  // namespace gloam::cli
