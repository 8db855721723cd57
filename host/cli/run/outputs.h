// The files that gloam run writes of a frame, by its flags.
#pragma once

#include <string>
#include <vector>

#include "cli/run/command.h"
#include "cli/shot/shot.h"
#include "shot/outputs.h"

namespace gloam::cli {

/// Decides what is written: -o OUT.png is --picture OUT.png, and where nothing is said, the result lies beside the frame,
/// frame_ao.exr of frame.exr. Throws UsageError for two pictures and for a shot, and Error where a file of that name is not such a result.
void settle_outputs(RunCommand& flags);

FrameOutputs outputs_of(const RunCommand& flags);

/// Those asked for, with their flags.
std::vector<NamedPath> named(const FrameOutputs& outputs);
std::vector<std::string> paths_of(const FrameOutputs& outputs);

/// Throws UsageError if nothing is asked for, for names that are not of EXR files, for a copy of two files, and for flags of a file
/// that is not written.
void check(const FrameOutputs& outputs, const RunCommand& flags);

/// `plan`: of the frame. Throws UsageError for a composite of planes that are not laid over colour.
OutputSettings output_settings(const RunCommand& flags, const PlanRequest& request, const Plan& plan);

/// Appends the patterns with their flags. Throws UsageError for names that are not patterns.
ShotOutputs outputs_of_shot(const FrameOutputs& outputs, const std::string& shot, NamedPatterns& patterns);

}  // namespace gloam::cli
