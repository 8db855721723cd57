// The values that a PNG stores, for measuring: no colour space is applied.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Values from 0 to `largest`, as stored.
struct PngValues {
  int bits = 8;                   ///< 8 or 16; fewer are brought to 8
  int largest = 255;              ///< 255 or 65535
  std::vector<Channel> channels;  ///< one of grey, three of colours, and alpha where it is asked for and there
};

/// What a PNG's header says before anything is decoded: its size, and the bytes that decoding takes.
struct PngSize {
  int width = 0, height = 0;
  unsigned long long bytes = 0;
};

enum class PngAlpha { left_out, kept };

/// `check` throws for a size that is not wanted. Throws Error naming `path` if it is no PNG, damaged, or larger than `max_pixels`.
PngValues read_png_values(const std::filesystem::path& path, const std::function<void(const PngSize&)>& check = {},
                          PngAlpha alpha = PngAlpha::left_out);

}  // namespace gloam
