#include "cli/shot.h"

#include <map>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

namespace fs = std::filesystem;

std::vector<FramePattern> patterns_of(const FrameArguments& inputs) {
  std::vector<FramePattern> patterns = {FramePattern(inputs.frame, "FRAME.exr")};
  if (!inputs.other_eye.empty()) patterns.emplace_back(inputs.other_eye, "RIGHT.exr");
  return patterns;
}

/// The numbers of the frames' files, each once: of one that is held several frames are read.
std::vector<int> sources_of(const std::vector<SequenceFrame>& frames) {
  std::vector<int> sources;
  for (const SequenceFrame& frame : frames) {
    if (sources.empty() || sources.back() != frame.source) sources.push_back(frame.source);
  }
  return sources;
}

std::string canonical_name(const fs::path& path) {
  std::error_code unknown;
  const fs::path found = fs::weakly_canonical(path, unknown);
  return (unknown ? path : found).string();
}

}  // namespace

ShotFiles::ShotFiles(const FrameArguments& inputs, const FrameFlags& flags, const FrameChoice& choice)
    : ShotFiles(patterns_of(inputs), flags, choice) {}

ShotFiles::ShotFiles(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice)
    : inputs_(std::move(inputs)), options_(flags.read_options()) {
  std::vector<std::string> notes;
  frames_ = list_frames(inputs_, choice, notes);
  note(notes);
  if (flags.camera.empty()) return;
  if (FramePattern::is_pattern(flags.camera))
    cameras_.emplace(flags.camera, "--camera");
  else
    camera_list_ = CameraList::of_file(flags.camera, sources_of(frames_));
}

std::vector<int> ShotFiles::numbers() const {
  std::vector<int> numbers;
  for (const SequenceFrame& frame : frames_) numbers.push_back(frame.number);
  return numbers;
}

std::string ShotFiles::name() const {
  std::vector<std::string> names;
  for (const FramePattern& pattern : inputs_) names.push_back(pattern.name());
  return enumerate(names);
}

std::vector<std::string> ShotFiles::paths_of(const SequenceFrame& frame) const {
  std::vector<std::string> paths;
  for (const FramePattern& pattern : inputs_) paths.push_back(pattern.path_of(frame.source).string());
  return paths;
}

std::string ShotFiles::camera_of(const SequenceFrame& frame) const {
  if (cameras_) return cameras_->path_of(frame.source).string();
  return camera_list_ ? "" : options_.camera_file.string();
}

ReadOptions ShotFiles::options_for(const SequenceFrame& frame) const {
  ReadOptions options = options_;
  if (cameras_) options.camera_file = cameras_->path_of(frame.source);
  if (camera_list_) options.camera_text = camera_list_->text_of(frame.source);
  return options;
}

void check_no_shot(const FrameArguments& frame, const std::vector<NamedPath>& outputs, const std::string& flag) {
  for (const auto& [output, path] : outputs) {
    if (FramePattern::is_pattern(path))
      throw UsageError("{} {}: is a pattern, and {} is one frame; write both as patterns, such as shot.####.exr",
                       output, path, frame.frame);
  }
  if (!flag.empty())
    throw UsageError("{}: is for a shot, and {} is one frame; write its number as in shot.####.exr", flag, frame.frame);
}

void check_outputs(const NamedPatterns& patterns, const ShotFiles& shot, const std::vector<NamedPath>& other_outputs) {
  std::map<std::string, int> inputs;  // the frame that reads a file
  for (const SequenceFrame& frame : shot.frames()) {
    for (const std::string& path : shot.paths_of(frame)) inputs.emplace(canonical_name(path), frame.number);
  }
  const auto check_no_input = [&](const std::string& flag, const fs::path& path) {
    const auto input = inputs.find(canonical_name(path));
    if (input == inputs.end()) return;
    throw UsageError("{}: {} is also what frame {} is read from; name another file", flag, path.string(),
                     input->second);
  };
  for (const auto& [flag, pattern] : patterns) {
    for (const SequenceFrame& frame : shot.frames())
      check_no_input(flag + " " + pattern.text(), pattern.path_of(frame.number));
  }
  for (const auto& [flag, path] : other_outputs) {
    if (!path.empty()) check_no_input(flag + " " + path, path);
  }
  // The folder is that of every frame.
  const SequenceFrame& first = shot.frames().front();
  std::vector<NamedPath> outputs;
  for (const auto& [flag, pattern] : patterns) outputs.emplace_back(flag, pattern.path_of(first.number).string());
  outputs.insert(outputs.end(), other_outputs.begin(), other_outputs.end());
  check_paths({{"--camera", shot.camera_of(first)}}, outputs);
}

}  // namespace gloam::cli
