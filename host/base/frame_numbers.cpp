#include "gloam/frame_numbers.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "gloam/error.h"

namespace gloam {
namespace {

/// A whole number of digits alone.
std::optional<int> number_in(std::string_view text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || text.front() == '-' || error != std::errc() || stop != end || value > last_frame_number)
    return {};
  return value;
}

struct FrameRange {
  int first, last, step;
  size_t count() const { return size_t((last - first) / step) + 1; }
};

/// "7", "1-9" or "1-9x2".
std::optional<FrameRange> range_in(std::string_view text) {
  const size_t dash = text.find('-');
  if (dash == std::string_view::npos) {
    const std::optional<int> only = number_in(text);
    return only ? std::optional(FrameRange{*only, *only, 1}) : std::nullopt;
  }
  const size_t cross = text.find('x', dash);
  const bool has_step = cross != std::string_view::npos;
  const std::optional<int> first = number_in(text.substr(0, dash)),
                           last = number_in(text.substr(dash + 1, has_step ? cross - dash - 1 : cross)),
                           step = has_step ? number_in(text.substr(cross + 1)) : 1;
  if (!first || !last || !step || *first > *last || *step < 1) return {};
  return FrameRange{*first, *last, *step};
}

}  // namespace

std::vector<int> parse_frame_numbers(const std::string& text, const std::string& flag) {
  std::vector<int> frames;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<FrameRange> range = range_in(std::string_view(text).substr(begin, end - begin));
    if (!range) throw UsageError("{} {} is not allowed; frames are, such as 1001-1100, 1-99x2 or 1,5,9-12", flag, text);
    if (frames.size() + range->count() > most_frames)
      throw UsageError("{} {} names more than {} frames; name fewer", flag, text, most_frames);
    for (size_t i = 0; i < range->count(); ++i) frames.push_back(range->first + int(i) * range->step);
    begin = end + 1;
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

std::vector<std::pair<int, int>> ranges_of(const std::vector<int>& frames) {
  std::vector<std::pair<int, int>> ranges;
  for (const int frame : frames) {
    if (!ranges.empty() && frame == ranges.back().second + 1)
      ranges.back().second = frame;
    else
      ranges.emplace_back(frame, frame);
  }
  return ranges;
}

std::string frames_in_words(const std::vector<int>& frames, size_t most_ranges) {
  std::string words;
  size_t ranges = 0, told = 0;
  for (const auto& [first, last] : ranges_of(frames)) {
    if (ranges++ == most_ranges) return words + fmt::format(" and {} more", frames.size() - told);
    told += size_t(last - first) + 1;
    if (!words.empty()) words += ", ";
    words += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
  }
  return words;
}

std::optional<int> last_number(const std::string& text) {
  const size_t last = text.find_last_of("0123456789");
  if (last == std::string::npos) return {};
  const size_t first = text.find_last_not_of("0123456789", last) + 1;
  if (last - first >= 9) return {};
  return std::stoi(text.substr(first, last + 1 - first));
}

}  // namespace gloam
