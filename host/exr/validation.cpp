#include "exr/validation.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <bit>

#include "exr/attributes.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

int bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

int64_t lines_per_chunk(const Imf::Header& header) {
  switch (header.compression()) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 32;
  }
}

/// Sizes are 32 bits without a sign: their product may not fit into 64 with one.
int64_t pixels_per_tile(const Imf::TileDescription& tile) {
  return int64_t(std::min<uint32_t>(tile.xSize, INT32_MAX)) * std::min<uint32_t>(tile.ySize, INT32_MAX);
}

}  // namespace

int64_t bytes_per_pixel(const Imf::Header& header) {
  int64_t bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) bytes += bytes_of(c.channel().type);
  return bytes;
}

int64_t pixels_per_chunk(const Imf::Header& header) {
  if (header.hasTileDescription()) return pixels_per_tile(header.tileDescription());
  const Box data = box_of(header.dataWindow());
  return (data.x1 - data.x0) * std::min(data.y1 - data.y0, lines_per_chunk(header));
}

int64_t rows_per_chunk(const Imf::Header& header) {
  const Box data = box_of(header.dataWindow());
  const int64_t rows = header.hasTileDescription() ? int64_t(header.tileDescription().ySize) : lines_per_chunk(header);
  return std::min(data.y1 - data.y0, rows);
}

Box box_of(const Imath::Box2i& box) { return {box.min.x, box.min.y, int64_t(box.max.x) + 1, int64_t(box.max.y) + 1}; }

Box united(const Box& a, const Box& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

Window window_of(const Box& box) { return {int(box.x0), int(box.y0), int(box.x1), int(box.y1)}; }

void check_size(const fs::path& path, const Box& box, const char* what, long long most_pixels) {
  constexpr int64_t end = 1LL << 30;  // coordinates beyond it overflow in OpenEXR
  if (box.empty()) throw Error("{}: corrupted EXR: its {} window is empty", path.string(), what);
  if (!box.larger_than(most_pixels) && box.x0 > -end && box.y0 > -end && box.x1 < end && box.y1 < end) return;
  throw Error("{}: claims a {} window of {} x {} pixels; at most 2^{} pixels in all are read", path.string(), what,
              box.x1 - box.x0, box.y1 - box.y0, std::bit_width(uint64_t(most_pixels)) - 1);
}

void check_claims(const fs::path& path, ExrInput& stream, long long most_pixels) {
  char start[8];
  stream.read(start, 8);
  const unsigned flags = unsigned(uint8_t(start[5])) << 8;
  int version = int(uint8_t(start[4]) | flags);
  check_attributes(path, stream, flags & Imf::MULTI_PART_FILE_FLAG);
  try {
    do {
      Imf::Header header;
      header.readFrom(stream, version);
      if (header.readsNothing()) break;
      check_size(path, box_of(header.displayWindow()), "display", most_pixels);
      check_size(path, box_of(header.dataWindow()), "data", most_pixels);
    } while (flags & Imf::MULTI_PART_FILE_FLAG);
  } catch (const IEX_NAMESPACE::BaseExc&) {
  }
  stream.seekg(0);
}

// No codec packs a million to one.
void check_plausible(const fs::path& path, const Imf::Header& header, uint64_t file_size) {
  const Box data = box_of(header.dataWindow());
  const int64_t width = data.x1 - data.x0, height = data.y1 - data.y0, per_pixel = bytes_per_pixel(header);
  const bool honest = pixels_per_chunk(header) <= INT32_MAX / std::max<int64_t>(per_pixel, 1) &&
                      uint64_t(width * height) / (1 << 20) * uint64_t(per_pixel) <= file_size;
  if (!honest)
    throw Error("{}: truncated or corrupted EXR (claims {} x {} pixels in {} bytes); render or copy it again",
                path.string(), width, height, file_size);
}

}  // namespace gloam
