#include "exr/whole_chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfVersion.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "exr/box.h"
#include "exr/chunks.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Numbers from `first` to `last`, both included, that `step` divides.
int64_t multiples(int64_t first, int64_t last, int64_t step) {
  const auto below = [&](int64_t n) { return n >= 0 ? n / step : -((-n + step - 1) / step); };
  return below(last) - below(first - 1);
}

/// What the pixels of a box take, uncompressed.
size_t bytes_of(const Imf::Header& header, const Box& box) {
  int64_t bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const Imf::Channel& channel = c.channel();
    bytes += multiples(box.y0, box.y1 - 1, channel.ySampling) * multiples(box.x0, box.x1 - 1, channel.xSampling) *
             (channel.type == Imf::HALF ? 2 : 4);
  }
  return size_t(bytes);
}

/// Bytes that runs stand for: a count below 0 comes before so many bytes as they are, another before a byte that is repeated.
size_t bytes_of_runs(const char* runs, size_t size) {
  size_t bytes = 0;
  for (size_t at = 0; at < size;) {
    const int count = static_cast<signed char>(runs[at]);
    at += count < 0 ? size_t(1 - count) : 2;
    bytes += count < 0 ? size_t(-count) : size_t(count) + 1;
  }
  return bytes;
}

/// A chunk as the file has it: compressed, or as it is if that makes it no smaller.
struct Stored {
  const char* bytes;
  size_t size;
};

class Check {
 public:
  explicit Check(Imf::Compression compression) : compression_(compression) {}

  /// Whether the compression lets chunks hold any number of bytes.
  bool is_needed() const {
    return is_zip() || compression_ == Imf::NO_COMPRESSION || compression_ == Imf::RLE_COMPRESSION;
  }

  /// `place`: "row 3".
  void operator()(const std::string& place, Stored chunk, size_t expected) {
    size_t bytes = chunk.size;
    if (bytes < expected && is_zip()) bytes = inflated(chunk, expected);
    if (bytes < expected && compression_ == Imf::RLE_COMPRESSION) bytes = bytes_of_runs(chunk.bytes, chunk.size);
    if (bytes < expected)
      throw std::runtime_error(fmt::format("the chunk of {} holds {} of {} bytes", place, bytes, expected));
  }

 private:
  bool is_zip() const { return compression_ == Imf::ZIP_COMPRESSION || compression_ == Imf::ZIPS_COMPRESSION; }

  /// Bytes that a chunk inflates to; as many as are expected if it is damaged in a way that OpenEXR notices.
  size_t inflated(Stored chunk, size_t expected) {
    bytes_.resize(expected);
    size_t got = 0;
    const libdeflate_result result =
        libdeflate_zlib_decompress(inflate_.get(), chunk.bytes, chunk.size, bytes_.data(), expected, &got);
    return result == LIBDEFLATE_SUCCESS ? got : expected;
  }

  Imf::Compression compression_;
  std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflate_{libdeflate_alloc_decompressor(),
                                                                                        libdeflate_free_decompressor};
  std::vector<char> bytes_;
};

template <typename Number>
Number number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// Where a file's table of a part's chunks begins: the tables follow the headers, and each other.
uint64_t table_of(const ExrFile& file, int part) {
  uint64_t table = file.end_of_headers;
  for (int before = 0; before < part; ++before)
    table += sizeof(uint64_t) * uint64_t(file.headers.of_part(before).chunkCount());
  return table;
}

/// Reads a tile as the file has it into `bytes`. Throws std::runtime_error where the table of chunks does not lead to it: OpenEXR would
/// look for the tile by itself.
Stored stored_tile(const ExrFile& file, uint64_t place_in_table, int x, int y, std::vector<char>& bytes) {
  char offset[8], head[20] = {};
  file.stream->read_at(place_in_table, offset, sizeof offset);
  const uint64_t begin = number_at<uint64_t>(offset) + (Imf::isMultiPart(file.parts->version()) ? 4 : 0);  // its number
  const uint64_t size_of_file = file.stream->size();
  const bool is_inside = begin < size_of_file && size_of_file - begin >= sizeof head;
  if (is_inside) file.stream->read_at(begin, head, sizeof head);  // place of the tile, of its level, and its size
  const int32_t size = number_at<int32_t>(head + 16);
  const bool is_it = number_at<int32_t>(head) == x && number_at<int32_t>(head + 4) == y && size >= 0;
  if (!is_inside || !is_it || uint64_t(size) > size_of_file - begin - sizeof head)
    throw std::runtime_error(fmt::format("the table of tiles does not lead to tile {}, {}", x, y));
  bytes.resize(size_t(size));
  file.stream->read_at(begin + sizeof head, bytes.data(), size_t(size));
  return {bytes.data(), size_t(size)};
}

}  // namespace

void check_whole_chunks(Imf::InputPart& input, int64_t first, int64_t last) {
  const Imf::Header& header = input.header();
  Check check(header.compression());
  if (!check.is_needed()) return;
  const Box data = box_of(header.dataWindow());
  const int64_t rows = rows_per_chunk(header);
  for (int64_t y = first - (first - data.y0) % rows; y < last; y += rows) {
    const Box covered{data.x0, y, data.x1, std::min(y + rows, data.y1)};
    const char* chunk = nullptr;
    int size = 0;
    input.rawPixelData(int(y), chunk, size);
    check(fmt::format("row {}", y), {chunk, size_t(std::max(size, 0))}, bytes_of(header, covered));
  }
}

void check_whole_tiles(const ExrFile& file, int part, int64_t first, int64_t last) {
  const Imf::Header& header = file.headers.of_part(part);
  Check check(header.compression());
  if (!check.is_needed() || std::endian::native != std::endian::little) return;
  Imf::TiledInputPart input(*file.parts, part);
  const uint64_t table = table_of(file, part);
  std::vector<char> bytes;
  for (int y = int(first); y <= int(last); ++y) {
    for (int x = 0; x < input.numXTiles(0); ++x) {
      const uint64_t index = uint64_t(y) * uint64_t(input.numXTiles(0)) + uint64_t(x);
      const Stored tile = stored_tile(file, table + sizeof(uint64_t) * index, x, y, bytes);
      check(fmt::format("tile {}, {}", x, y), tile, bytes_of(header, box_of(input.dataWindowForTile(x, y, 0))));
    }
  }
}

}  // namespace gloam
