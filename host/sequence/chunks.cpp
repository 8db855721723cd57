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

}  // namespace gloam
