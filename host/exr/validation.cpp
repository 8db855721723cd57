#include "exr/validation.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <bit>

#include "exr/attribute_sizes.h"
#include "exr/chunks.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

void check_windows(const fs::path& path, const Imf::Header& header, long long most_pixels) {
  check_size(path, box_of(header.displayWindow()), "display", most_pixels);
  check_size(path, box_of(header.dataWindow()), "data", most_pixels);
}

}  // namespace

void check_size(const fs::path& path, const Box& box, const char* what, long long most_pixels) {
  constexpr int64_t end = 1LL << 30;  // larger coordinates overflow in OpenEXR
  if (box.empty()) throw Error("{}: corrupted EXR: its {} window is empty", path.string(), what);
  if (!box.larger_than(most_pixels) && box.x0 > -end && box.y0 > -end && box.x1 < end && box.y1 < end) return;
  throw Error("{}: claims a {} window of {} x {} pixels; at most 2^{} pixels in all are read", path.string(), what,
              box.x1 - box.x0, box.y1 - box.y0, std::bit_width(uint64_t(most_pixels)) - 1);
}

uint64_t check_headers(const fs::path& path, ExrInput& stream, long long most_pixels) {
  char start[8];
  stream.read(start, 8);
  const unsigned flags = unsigned(uint8_t(start[5])) << 8;
  int version = int(uint8_t(start[4]) | flags);
  const uint64_t end = check_attribute_sizes(path, stream, flags & Imf::MULTI_PART_FILE_FLAG);
  try {
    do {
      Imf::Header header;
      header.readFrom(stream, version);
      if (header.readsNothing()) break;
      check_windows(path, header, most_pixels);
    } while (flags & Imf::MULTI_PART_FILE_FLAG);
  } catch (const IEX_NAMESPACE::BaseExc&) {
  }
  stream.seekg(0);
  return end;
}

void check_parts(const fs::path& path, const Imf::MultiPartInputFile& file, long long most_pixels) {
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (header.hasType() && Imf::isDeepData(header.type()))
      throw Error("{}: is a deep EXR, with many samples per pixel; flatten it first", path.string());
    check_windows(path, header, most_pixels);
  }
}

// No codec compresses a million to one.
void check_plausible(const fs::path& path, const Imf::Header& header, uint64_t file_size) {
  const Box data = box_of(header.dataWindow());
  const int64_t width = data.x1 - data.x0, height = data.y1 - data.y0, per_pixel = bytes_per_pixel(header);
  const bool is_plausible = pixels_per_chunk(header) <= INT32_MAX / std::max<int64_t>(per_pixel, 1) &&
                            uint64_t(width * height) / (1 << 20) * uint64_t(per_pixel) <= file_size;
  if (!is_plausible)
    throw Error("{}: truncated or corrupted EXR (claims {} x {} pixels in {} bytes); render or copy it again",
                path.string(), width, height, file_size);
}

}  // namespace gloam
