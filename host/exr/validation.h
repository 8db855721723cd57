// What an EXR header claims, looked at before anything is allocated for it.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <cstdint>
#include <filesystem>

#include "exr/stream.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// Ends exclusive and in 64 bits, so that a fuzzed window cannot overflow.
struct Box {
  int64_t x0, y0, x1, y1;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool larger_than(int64_t pixels) const {
    return x1 - x0 > pixels || y1 - y0 > pixels || (x1 - x0) * (y1 - y0) > pixels;
  }
};

Box box_of(const Imath::Box2i& box);
Box united(const Box& a, const Box& b);
Window window_of(const Box& box);

/// Throws Error naming the file for a window that is empty, overflows or has more than `most_pixels` pixels.
void check_size(const std::filesystem::path& path, const Box& box, const char* what, long long most_pixels);

/// Looks at the attributes and windows of all headers before OpenEXR makes room for what they claim. A header that cannot
/// be parsed is left to OpenEXR to refuse.
void check_claims(const std::filesystem::path& path, ExrInput& stream, long long most_pixels);

/// What all channels of a part take of the file for a pixel, before compression.
int64_t bytes_per_pixel(const Imf::Header& header);
/// What is packed together, and so is unpacked together: some rows, or a tile.
int64_t pixels_per_chunk(const Imf::Header& header);
int64_t rows_per_chunk(const Imf::Header& header);

/// Refuses a part whose buffers could not be honest for a file of this size.
void check_plausible(const std::filesystem::path& path, const Imf::Header& header, uint64_t file_size);

}  // namespace gloam
