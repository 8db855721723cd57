#include "sequence/chunks.h"

#include <algorithm>
#include <string_view>

#include "gloam/error.h"

namespace gloam {

std::vector<std::vector<int>> chunks_of(const std::vector<int>& frames, int count) {
  const size_t chunks = std::min(size_t(std::max(count, 0)), frames.size());
  std::vector<std::vector<int>> result;
  for (size_t i = 0; i < chunks; ++i) {
    const size_t first = frames.size() * i / chunks, last = frames.size() * (i + 1) / chunks;
    result.emplace_back(frames.begin() + std::ptrdiff_t(first), frames.begin() + std::ptrdiff_t(last));
  }
  return result;
}

std::string frames_as_flag(const std::vector<int>& frames) {
  std::string text;
  for (size_t first = 0, last = 0; first < frames.size(); first = last + 1) {
    last = first;
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
    if (!text.empty()) text += ",";
    text += last == first ? fmt::format("{}", frames[first]) : fmt::format("{}-{}", frames[first], frames[last]);
  }
  return text;
}

std::string quoted_for_shell(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace gloam
