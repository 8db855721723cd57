#include "exr/verify.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfTiledInputPart.h>

#include <algorithm>
#include <list>
#include <vector>

#include "exr/validation.h"
#include "exr/whole_chunks.h"

namespace gloam {
namespace {

/// A multiple of the rows in every codec's block, so that no block is decoded twice.
constexpr int band_rows = 256;

/// Memory for one band of the channels to decode.
class Band {
 public:
  Band(const Imf::Header& header, int part, const std::set<std::pair<int, std::string>>& decoded, int rows)
      : window_(header.dataWindow()), rows_(rows) {
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      if (decoded.count({part, c.name()}) == 0) channels_.push_back({c.name(), c.channel(), {}});
    }
  }

  bool empty() const { return channels_.empty(); }

  /// Slices whose first row is `y`.
  Imf::FrameBuffer slices(int y) {
    const int width = window_.max.x - window_.min.x + 1;
    Imf::FrameBuffer buffer;
    for (Pixels& c : channels_) {
      c.memory.resize(size_t(width) * size_t(rows_));
      buffer.insert(c.name, Imf::Slice::Make(Imf::FLOAT, c.memory.data(), Imath::V2i(window_.min.x, y), width, rows_,
                                             sizeof(float), sizeof(float) * size_t(width), c.channel.xSampling,
                                             c.channel.ySampling));
    }
    return buffer;
  }

 private:
  struct Pixels {
    std::string name;
    Imf::Channel channel;
    std::vector<float> memory;
  };
  Imath::Box2i window_;
  int rows_;
  std::list<Pixels> channels_;
};

void decode_scanlines(const ExrFile& file, int part, const std::set<std::pair<int, std::string>>& decoded) {
  const Imf::Header& header = file.headers.of_part(part);
  const Imath::Box2i window = header.dataWindow();
  const int rows = std::min(band_rows, window.max.y - window.min.y + 1);
  Band band(header, part, decoded, rows);
  if (band.empty()) return;
  Imf::InputPart input(*file.parts, part);
  for (int y = window.min.y; y <= window.max.y; y += rows) {
    const int last = std::min(y + rows - 1, window.max.y);
    check_whole_chunks(input, y, last + 1);
    input.setFrameBuffer(band.slices(y));
    input.readPixels(y, last);
  }
}

void decode_tiles(const ExrFile& file, int part, const std::set<std::pair<int, std::string>>& decoded) {
  Imf::TiledInputPart input(*file.parts, part);
  const Imf::Header& header = file.headers.of_part(part);
  const Imath::Box2i window = header.dataWindow();
  // A tile may be far larger than the image.
  const int64_t rows = std::min(int64_t(input.tileYSize()), int64_t(window.max.y) - window.min.y + 1);
  Band band(header, part, decoded, int(rows));
  if (band.empty()) return;
  check_whole_tiles(file, part, 0, input.numYTiles(0) - 1);
  for (int tile_y = 0; tile_y < input.numYTiles(0); ++tile_y) {
    input.setFrameBuffer(band.slices(input.dataWindowForTile(0, tile_y, 0).min.y));
    input.readTiles(0, input.numXTiles(0) - 1, tile_y, tile_y, 0);
  }
}

}  // namespace

void decode_the_rest(const ExrFile& file, const std::set<std::pair<int, std::string>>& decoded) {
  for (int part = 0; part < file.headers.parts(); ++part) {
    if (is_deep(file.headers.of_part(part))) continue;
    if (file.headers.of_part(part).hasTileDescription()) {
      decode_tiles(file, part, decoded);
    } else {
      decode_scanlines(file, part, decoded);
    }
  }
}

}  // namespace gloam
