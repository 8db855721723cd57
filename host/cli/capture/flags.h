// The requests of the flags of gloam capture. UsageError if flags do not go together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/capture/command.h"

namespace gloam::cli {

/// The planes of --planes; without it all but motion, which needs a path.
std::vector<std::string> planes_of(const CaptureCommand& flags);
StochasticOptions stochastic_of(const CaptureCommand& flags);
/// None without --outlines.
std::optional<OutlineOptions> outlines_of(const CaptureCommand& flags);
/// Degrees by which the second view is turned; none without --view2.
std::optional<double> second_view_of(const CaptureCommand& flags);
/// Distance and convergence of two eyes; none without --stereo.
std::optional<StereoRig> stereo_of(const CaptureCommand& flags);
/// Refuses more than one of the flags that decide the views of a frame.
void check_second_view_flags(const CaptureCommand& flags);

}  // namespace gloam::cli
