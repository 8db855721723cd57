// What a file holds, in words, for messages.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame_files.h"

namespace gloam {

/// "R, G, B and 7 more": as many names as a person reads.
std::string first_names(std::vector<std::string> names);

/// "--plane depth=Y takes its only channel for the depth", or how channels of other names are taken; empty where the file has depth, or no
/// channel that nothing reads.
std::string hint_on_depth(const FrameFile& file);

/// "beauty.exr has only R, G, B", with the hint.
std::string holdings(const FrameFile& file);
std::string holdings(const FrameFiles& files);

}  // namespace gloam
