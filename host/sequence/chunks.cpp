#include "sequence/chunks.h"

#include <string_view>

#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {

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
