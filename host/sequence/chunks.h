// A list of frames divided into chunks, for as many processes.
#pragma once

#include <string>
#include <vector>

namespace gloam {

/// Frames one after another, as evenly as possible; never more chunks than frames.
std::vector<std::vector<int>> chunks_of(const std::vector<int>& frames, int count);

/// Frames as parse_frame_numbers (frame_numbers.h) reads them: "1-3,7,9-12".
std::string frames_as_flag(const std::vector<int>& frames);

/// A word as a POSIX shell reads it back: in quotes where it needs them.
std::string quoted_for_shell(const std::string& word);

}  // namespace gloam
