#include "exr/chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>

#include "exr/box.h"

namespace gloam {
namespace {

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

/// Sizes are unsigned 32-bit numbers: their product may not fit into a signed 64-bit number.
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

uint64_t decoder_bytes(const Imf::Header& header) {
  const uint64_t chunks = uint64_t(std::max(2 * Imf::globalThreadCount(), 1));
  return chunks * 2 * uint64_t(pixels_per_chunk(header) * bytes_per_pixel(header));
}

}  // namespace gloam
