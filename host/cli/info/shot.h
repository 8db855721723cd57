// gloam info on a shot: a line for each frame, and what differs between them.
#pragma once

#include <string>

#include "cli/flags/options.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

/// Reads headers alone. Throws Error if no frame is there, and at the end if a frame cannot be read.
void describe_shot(const std::string& pattern, const FrameChoice& choice, const FrameFlags& flags, const JsonFlag& json,
                   const std::string& reading);

}  // namespace gloam::cli
