#include "cli/shot/shot.h"

#include "base/file_ledger.h"
#include "base/files.h"
#include "gloam/error.h"

namespace gloam::cli {

SequenceFiles shot_files(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice) {
  std::vector<std::string> notes;
  SequenceFiles files(std::move(inputs), flags.read_options(), choice, notes);
  note(notes);
  return files;
}

SequenceFiles shot_files(const FrameArguments& inputs, const FrameFlags& flags, const FrameChoice& choice) {
  std::vector<FramePattern> patterns = {FramePattern(inputs.frame, "FRAME.exr")};
  if (!inputs.other_eye.empty()) patterns.emplace_back(inputs.other_eye, "RIGHT.exr");
  return shot_files(std::move(patterns), flags, choice);
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

void check_outputs(const NamedPatterns& patterns, const SequenceFiles& shot,
                   const std::vector<NamedPath>& other_outputs) {
  for (const auto& [flag, pattern] : patterns) {
    for (const SequenceFrame& frame : shot.frames()) writes_file(flag, pattern.path_of(frame.number));
  }
  // The folder is that of every frame.
  const SequenceFrame& first = shot.frames().front();
  std::vector<NamedPath> outputs;
  for (const auto& [flag, pattern] : patterns) outputs.emplace_back(flag, pattern.path_of(first.number).string());
  outputs.insert(outputs.end(), other_outputs.begin(), other_outputs.end());
  check_paths({}, outputs);
}

void say_how_to_go_on() {
  say_on_interruption("frames that were written are whole; the same command with --resume goes on");
}

}  // namespace gloam::cli
