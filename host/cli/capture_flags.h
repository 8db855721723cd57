// What the flags of gloam capture ask for; UsageError where they do not go together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/capture_command.h"

namespace gloam::cli {

/// All planes but motion, which needs a path.
std::vector<std::string> planes_of(const CaptureCommand& flags);
StochasticOptions stochastic_of(const CaptureCommand& flags);
/// None where none are wanted.
std::optional<OutlineOptions> outlines_of(const CaptureCommand& flags);
/// By how many degrees the second view is turned; none where none is wanted.
std::optional<double> second_view_of(const CaptureCommand& flags);
/// How two eyes stand to each other; none where one view is wanted.
std::optional<StereoRig> stereo_of(const CaptureCommand& flags);
/// Each says which views a frame has.
void check_second_view_flags(const CaptureCommand& flags);

}  // namespace gloam::cli
