#include "exr/decode.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfTiledInputPart.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "exr/whole_chunks.h"
#include "exr/zip_rows.h"
#include "gloam/error.h"

namespace gloam {
namespace {

Imf::Slice slice_of(Channel& channel, const Window& window) {
  const Layout& layout = channel.layout();
  return Imf::Slice::Make(Imf::FLOAT, channel.row(0), Imath::V2i(window.x0, window.y0), layout.width, layout.height,
                          sizeof(float), sizeof(float) * size_t(layout.pitch));
}

Imf::FrameBuffer frame_buffer(PartDecoding& decoding, const Window& window) {
  Imf::FrameBuffer buffer;
  for (auto& [name, target] : decoding) buffer.insert(name, slice_of(*target.targets.front(), window));
  return buffer;
}

/// Sets the pixels outside the part's data window.
void fill_outside(Channel& channel, const Box& data, const Window& window, float value) {
  const int width = window.width();
  const int left = int(data.x0 - window.x0), right = int(data.x1 - window.x0);
  const int top = int(data.y0 - window.y0), bottom = int(data.y1 - window.y0);
  for (int y = 0; y < window.height(); ++y) {
    float* row = channel.row(y);
    if (y < top || y >= bottom) {
      std::fill(row, row + width, value);
      continue;
    }
    std::fill(row, row + left, value);
    std::fill(row + right, row + width, value);
  }
}

void copy_image(const Channel& from, Channel& to) { std::memcpy(to.data(), from.data(), from.layout().bytes()); }

/// Rows [first, last) of the file.
struct Rows {
  int64_t first, last;
};

/// Tiles are decoded whole. Tiles that the window cuts are decoded into memory of their own.
void decode_tiles(const ExrFile& file, int part, PartDecoding& decoding, const Box& data, const Window& window,
                  const Rows& rows) {
  Imf::TiledInputPart input(*file.parts, part);
  const int64_t tile = input.tileYSize(), first_tile = (rows.first - data.y0) / tile,
                last_tile = (rows.last - 1 - data.y0) / tile;
  const Rows whole{data.y0 + first_tile * tile, std::min(data.y0 + (last_tile + 1) * tile, data.y1)};
  check_whole_tiles(file, part, first_tile, last_tile);
  const auto read = [&](PartDecoding& into, const Window& covered) {
    input.setFrameBuffer(frame_buffer(into, covered));
    input.readTiles(0, input.numXTiles(0) - 1, int(first_tile), int(last_tile), 0);
  };
  if (whole.first >= window.y0 && whole.last <= window.y1) return read(decoding, window);
  const Window covered{window.x0, int(whole.first), window.x1, int(whole.last)};
  std::map<std::string, Channel> tiles;
  PartDecoding beside;
  for (const auto& [name, unused] : decoding) {
    Channel& channel = tiles.emplace(name, Layout(covered.width(), covered.height())).first->second;
    beside[name].targets = {&channel};
  }
  read(beside, covered);
  for (auto& [name, target] : decoding) {
    for (int64_t y = rows.first; y < rows.last; ++y)
      std::copy_n(tiles.at(name).row(int(y - whole.first)), window.width(),
                  target.targets.front()->row(int(y - window.y0)));
  }
}

}  // namespace

void check_sampling(const Imf::Header& header, const PartDecoding& decoding) {
  for (const auto& [name, unused] : decoding) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (channel && (channel->xSampling != 1 || channel->ySampling != 1))
      throw Error("channel '{}' is subsampled {} x {}; save it at full resolution", name, channel->xSampling,
                  channel->ySampling);
  }
}

void decode_part(const ExrFile& file, int part, PartDecoding& decoding, const Window& window) {
  const Imf::Header& header = file.headers.of_part(part);
  const Box data = box_of(header.dataWindow());
  const Rows rows{std::max(data.y0, int64_t(window.y0)), std::min(data.y1, int64_t(window.y1))};
  if (rows.first < rows.last && header.hasTileDescription()) {
    decode_tiles(file, part, decoding, data, window, rows);
  } else if (rows.first < rows.last) {
    Imf::InputPart input(*file.parts, part);
    if (!decode_zip_rows(input, decoding, window, rows.first, rows.last)) {
      check_whole_chunks(input, rows.first, rows.last);
      input.setFrameBuffer(frame_buffer(decoding, window));
      input.readPixels(int(rows.first), int(rows.last - 1));
    }
  }
  for (auto& [name, target] : decoding) {
    fill_outside(*target.targets.front(), data, window, target.outside);
    for (size_t i = 1; i < target.targets.size(); ++i) copy_image(*target.targets.front(), *target.targets[i]);
  }
}

long long count_nonfinite(const Channel& channel, const Box& data, const Window& window) {
  const int64_t top = std::max<int64_t>(data.y0 - window.y0, 0),
                bottom = std::min<int64_t>(data.y1 - window.y0, window.height());
  long long count = 0;
  for (int64_t y = top; y < bottom; ++y)
    for (int64_t x = data.x0 - window.x0; x < data.x1 - window.x0; ++x)
      count += !std::isfinite(channel.at(int(x), int(y)));
  return count;
}

}  // namespace gloam
