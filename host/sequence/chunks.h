// A list, such as of frames, divided into chunks, for as many processes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace gloam {

/// Items one after another, as evenly as possible; never more chunks than items.
template <typename Item>
std::vector<std::vector<Item>> chunks_of(const std::vector<Item>& items, int count) {
  const size_t chunks = std::min(size_t(std::max(count, 0)), items.size());
  std::vector<std::vector<Item>> result;
  for (size_t i = 0; i < chunks; ++i) {
    const size_t first = items.size() * i / chunks, last = items.size() * (i + 1) / chunks;
    result.emplace_back(items.begin() + std::ptrdiff_t(first), items.begin() + std::ptrdiff_t(last));
  }
  return result;
}

/// Frames as parse_frame_numbers (frame_numbers.h) reads them: "1-3,7,9-12".
std::string frames_as_flag(const std::vector<int>& frames);

}  // namespace gloam
