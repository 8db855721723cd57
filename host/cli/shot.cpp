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

std::string canonical_name(const fs::path& path) {
  std::error_code unknown;
  const fs::path found = fs::weakly_canonical(path, unknown);
  return (unknown ? path : found).string();
}

}  // namespace

ShotFiles::ShotFiles(const FrameArguments& inputs, const FrameFlags& flags, const FrameChoice& choice)
    : ShotFiles(patterns_of(inputs), flags, choice) {}

ShotFiles::ShotFiles(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice)
    : ShotFiles(std::move(inputs), flags, choice, {}) {}

ShotFiles::ShotFiles(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice,
                     std::vector<std::string> notes)
    : SequenceFiles(std::move(inputs), flags.read_options(), choice, notes) {
  note(notes);
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
