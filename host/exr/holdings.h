// What a file holds, in words, for messages.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame_files.h"

namespace gloam {

/// "R, G, B and 7 more": as many names as a person reads.
std::string first_names(std::vector<std::string> names);

/// "beauty.exr has only R, G, B"
std::string holdings(const FrameFile& file);
std::string holdings(const FrameFiles& files);

}  // namespace gloam
