#include "sequence/sequence_files.h"

#include <algorithm>
#include <memory>
#include <mutex>
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

/// Frames that are looked at for the convention of all: the first ones may be empty.
constexpr size_t most_looked_at = 5;

bool has_surface(const Frame& frame) {
  const Plane* depth = frame.views.front().find("depth");
  const Channel* values = depth ? &depth->channels.front() : nullptr;
  for (int y = 0; values && y < frame.height(); ++y) {
    const float* row = values->row(y);
    if (!std::all_of(row, row + frame.width(), is_background)) return true;
  }
  return false;
}

/// What the normals of a sequence tell: the first of its frames that can be read and shows a surface stands for all. `frames`: those to look
/// at. A frame that cannot be read is told when its turn comes.
FoundNormals normals_of(const SequenceFiles& sequence, const std::vector<SequenceFrame>& frames) {
  for (size_t i = 0; i < std::min(frames.size(), most_looked_at); ++i) {
    try {
      FrameFiles files = sequence.open(frames[i]);
      if (!has_surface(files.read({"depth", "normal"}))) continue;
      FoundNormals found = files.files().front().found_normals();
      for (std::string& note : found.notes)
        note += fmt::format(" (decided on frame {} for the whole sequence)", frames[i].number);
      return found;
    } catch (const Error&) {
    }
  }
  return {};
}

/// The frames that are there, whichever are asked for: so a frame has the same bits in every part of its shot. Cameras in the order of the
/// frames asked for belong to these alone.
std::vector<SequenceFrame> frames_to_look_at(const SequenceFiles& sequence) {
  if (sequence.cameras_are_in_order()) return sequence.frames();
  FrameChoice all;
  all.missing = MissingFrames::skip;
  std::vector<std::string> unused;
  return list_frames(sequence.inputs(), all, unused);
}

/// `normals_of`, worked out once, when the first thread asks.
std::function<FoundNormals()> normals_when_asked(std::shared_ptr<const SequenceFiles> sequence) {
  struct Kept {
    std::once_flag once;
    FoundNormals found;
  };
  return [kept = std::make_shared<Kept>(), sequence = std::move(sequence)] {
    std::call_once(kept->once, [&] { kept->found = normals_of(*sequence, frames_to_look_at(*sequence)); });
    return kept->found;
  };
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
  options_.shot_normals = normals_when_asked(std::make_shared<const SequenceFiles>(*this));
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
