#include "exr/whole_chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
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

/// What the rows [first, last) take, uncompressed.
size_t bytes_of_rows(const Imf::Header& header, const Box& data, int64_t first, int64_t last) {
  int64_t bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const Imf::Channel& channel = c.channel();
    bytes += multiples(first, last - 1, channel.ySampling) * multiples(data.x0, data.x1 - 1, channel.xSampling) *
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

class Inflating {
 public:
  /// Bytes that a chunk inflates to; as many as are expected if it is damaged in a way that OpenEXR notices.
  size_t bytes_of(const char* chunk, size_t size, size_t expected) {
    bytes_.resize(expected);
    size_t got = 0;
    const libdeflate_result result =
        libdeflate_zlib_decompress(inflate_.get(), chunk, size, bytes_.data(), expected, &got);
    return result == LIBDEFLATE_SUCCESS ? got : expected;
  }

 private:
  std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflate_{libdeflate_alloc_decompressor(),
                                                                                        libdeflate_free_decompressor};
  std::vector<char> bytes_;
};

}  // namespace

void check_whole_chunks(Imf::InputPart& input, int64_t first, int64_t last) {
  const Imf::Header& header = input.header();
  const Imf::Compression compression = header.compression();
  const bool is_zip = compression == Imf::ZIP_COMPRESSION || compression == Imf::ZIPS_COMPRESSION;
  if (!is_zip && compression != Imf::NO_COMPRESSION && compression != Imf::RLE_COMPRESSION) return;
  const Box data = box_of(header.dataWindow());
  const int64_t rows = rows_per_chunk(header);
  Inflating inflating;
  for (int64_t y = first - (first - data.y0) % rows; y < last; y += rows) {
    const size_t expected = bytes_of_rows(header, data, y, std::min(y + rows, data.y1));
    const char* chunk = nullptr;
    int size = 0;
    input.rawPixelData(int(y), chunk, size);
    size_t bytes = size_t(std::max(size, 0));
    if (bytes < expected && is_zip) bytes = inflating.bytes_of(chunk, bytes, expected);
    if (bytes < expected && compression == Imf::RLE_COMPRESSION) bytes = bytes_of_runs(chunk, bytes);
    if (bytes < expected)
      throw std::runtime_error(fmt::format("the chunk of row {} holds {} of {} bytes", y, bytes, expected));
  }
}

}  // namespace gloam
