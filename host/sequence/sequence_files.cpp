#include "sequence/sequence_files.h"

#include <utility>

#include "base/file_ledger.h"
#include "gloam/error.h"
#include "sequence/pattern_reads.h"

namespace gloam {
namespace {

/// The numbers of the frames' files, each once: of one that is held several frames are read.
std::vector<int> sources_of(const std::vector<SequenceFrame>& frames) {
  std::vector<int> sources;
  for (const SequenceFrame& frame : frames) {
    if (sources.empty() || sources.back() != frame.source) sources.push_back(frame.source);
  }
  return sources;
}

}  // namespace

SequenceFiles::SequenceFiles(std::vector<FramePattern> inputs, const ReadOptions& options, const FrameChoice& choice,
                             std::vector<std::string>& notes)
    : inputs_(std::move(inputs)), frames_(list_frames(inputs_, choice, notes)), options_(options) {
  const std::string camera = options.camera_file.string();
  if (FramePattern::is_pattern(camera))
    cameras_.emplace(camera, "--camera");
  else if (!camera.empty())
    camera_list_ = CameraList::of_file(camera, sources_of(frames_));
  tell_ledger();
}

void SequenceFiles::tell_ledger() const {
  if (!has_file_ledger()) return;
  for (const SequenceFrame& frame : frames_) {
    for (const std::string& path : paths_of(frame))
      reads_file(path, fmt::format("what frame {} is read from", frame.number));
  }
  for (const FramePattern& pattern : inputs_) {
    reads_pattern(pattern);
    if (options_.camera_file.empty()) reads_cameras_beside(pattern);
  }
  if (cameras_)
    reads_pattern(*cameras_);
  else
    reads_file(options_.camera_file, "--camera");
}

std::vector<int> SequenceFiles::numbers() const {
  std::vector<int> numbers;
  for (const SequenceFrame& frame : frames_) numbers.push_back(frame.number);
  return numbers;
}

std::string SequenceFiles::name() const {
  std::vector<std::string> names;
  for (const FramePattern& pattern : inputs_) names.push_back(pattern.name());
  return enumerate(names);
}

std::vector<std::string> SequenceFiles::paths_of(const SequenceFrame& frame) const {
  std::vector<std::string> paths;
  for (const FramePattern& pattern : inputs_) paths.push_back(pattern.path_of(frame.source).string());
  return paths;
}

std::string SequenceFiles::camera_of(const SequenceFrame& frame) const {
  if (cameras_) return cameras_->path_of(frame.source).string();
  return camera_list_ ? "" : options_.camera_file.string();
}

ReadOptions SequenceFiles::options_for(const SequenceFrame& frame) const {
  ReadOptions options = options_;
  if (cameras_) options.camera_file = cameras_->path_of(frame.source);
  if (camera_list_) options.camera_text = camera_list_->text_of(frame.source);
  return options;
}

}  // namespace gloam
