// The frames of a capture and their cameras: one frame, one for each moment of a path, or those of a light-field display.
#pragma once

#include <vector>

#include "cli/capture_command.h"

namespace gloam::cli {

/// One file with all modules, or one for each. The size is the display's if the flags give none.
std::vector<CaptureShot> shots_of_display(const CaptureCommand& flags, const Tracer& tracer, CaptureOptions& options);
/// One file, or one for each camera of a path.
std::vector<CaptureShot> shots_of(const CaptureCommand& flags, const Scene& scene, int width, int height);

/// "0,5,10-19": the first and the last of each item, whatever modules there are. Throws UsageError.
std::vector<std::pair<int, int>> parse_modules(const std::string& text, const std::string& flag);

}  // namespace gloam::cli
