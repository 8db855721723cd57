// A shot: frames whose files are named by patterns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/run/command.h"
#include "gloam/frame_files.h"
#include "gloam/frame_pattern.h"
#include "sequence/sequence_files.h"

namespace gloam::cli {

/// The files of a shot by flags, of any number of patterns. Adds its notes to those of the command.
SequenceFiles shot_files(std::vector<FramePattern> inputs, const FrameFlags& flags, const FrameChoice& choice);
SequenceFiles shot_files(const FrameArguments& inputs, const FrameFlags& flags, const FrameChoice& choice);

/// Throws UsageError for outputs that are patterns, and for a flag of shots, with one frame. `flag`: empty if none is given.
void check_no_shot(const FrameArguments& frame, const std::vector<NamedPath>& outputs, const std::string& flag);

/// Names of outputs with their flags.
using NamedPatterns = std::vector<std::pair<std::string, FramePattern>>;

/// As `check_paths`, with the outputs of all frames; what the shot reads it has told itself.
void check_outputs(const NamedPatterns& patterns, const SequenceFiles& shot,
                   const std::vector<NamedPath>& other_outputs);

/// From now on an interruption says that the frames written are whole, and what goes on.
void say_how_to_go_on();

}  // namespace gloam::cli
