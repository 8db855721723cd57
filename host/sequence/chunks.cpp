#include "sequence/chunks.h"

#include <algorithm>
#include <string_view>

#include "gloam/error.h"
#include "gloam/frame_numbers.h"

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
  for (const auto& [first, last] : ranges_of(frames)) {
    if (!text.empty()) text += ",";
    text += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
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
