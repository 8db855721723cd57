// Numbers of a sequence's frames, as text: "1001-1100", "1-100x2", "1,5,9-12".
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gloam {

/// Largest number of a frame: nine digits.
inline constexpr int last_frame_number = 999'999'999;
/// Largest number of frames that a text may name.
inline constexpr size_t most_frames = 1'000'000;

/// Numbers, ranges, and ranges with a step (1-9x2: 1, 3, 5, 7, 9), separated by commas; returned in ascending order, each once.
/// Throws UsageError, naming the flag, for text of another form.
std::vector<int> parse_frame_numbers(const std::string& text, const std::string& flag);

/// The number of a frame in a name or a text: its last digits. None without digits, or with more than a number has.
std::optional<int> last_number(const std::string& text);

/// First and last frames of the ranges without a gap, of frames in ascending order.
std::vector<std::pair<int, int>> ranges_of(const std::vector<int>& frames);

/// "1-3, 7, 9-12": ranges of frames in ascending order; after `most_ranges` of them "and 12 more".
std::string frames_in_words(const std::vector<int>& frames, size_t most_ranges = 8);

}  // namespace gloam
