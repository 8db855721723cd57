// The files that gloam run writes of a frame, by its flags.
#pragma once

#include <string>
#include <vector>

#include "cli/run/command.h"
#include "cli/shot/shot.h"
#include "shot/outputs.h"

namespace gloam::cli {

FrameOutputs outputs_of(const RunCommand& flags);

/// Those asked for, with their flags.
std::vector<NamedPath> named(const FrameOutputs& outputs);
std::vector<std::string> paths_of(const FrameOutputs& outputs);

/// Throws UsageError if nothing is asked for, for names that are not of EXR files, for a copy of two files, and for flags of a file
/// that is not written.
void check(const FrameOutputs& outputs, const RunCommand& flags);

/// `half`: AO of OUT.exr as half. `plan`: of the frame. Throws UsageError for a composite of planes that are not laid over colour.
OutputSettings output_settings(const RunCommand& flags, bool half, const PlanRequest& request, const Plan& plan);

/// Appends the patterns with their flags. Throws UsageError for names that are not patterns.
ShotOutputs outputs_of_shot(const FrameOutputs& outputs, const std::string& shot, NamedPatterns& patterns);

}  // namespace gloam::cli
