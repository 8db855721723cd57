#include "exr/memory.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/chunks.h"

namespace gloam {
namespace {

constexpr uint64_t bytes_at_once = 4 << 20;

}  // namespace

uint64_t plane_bytes(const ExrFile& file, const std::vector<std::string>& planes, int rows) {
  uint64_t channels = 0;
  for (const std::string& view : file.names.views)
    for (const std::string& plane : planes)
      if (const PlaneSource* from = file.source(plane, view))
        channels += from->channels.size();
      else
        channels += file.has(plane, view);
  return channels * Layout(file.window.width(), rows).bytes();
}

uint64_t decoder_bytes(const ExrFile& file, const std::vector<std::string>& planes) {
  uint64_t most = 0;
  for (const PlaneSource& plane : file.names.planes)
    for (const ChannelSource& channel : plane.channels)
      if (contains(planes, plane.plane)) most = std::max(most, decoder_bytes(file.headers.of_part(channel.part)));
  return most;
}

int rows_at_once(const ExrFile& file, const std::vector<std::string>& planes) {
  int64_t chunk = 1;
  for (const PlaneSource& plane : file.names.planes)
    for (const ChannelSource& channel : plane.channels)
      if (contains(planes, plane.plane)) chunk = std::max(chunk, rows_per_chunk(file.headers.of_part(channel.part)));
  const uint64_t row = std::max<uint64_t>(plane_bytes(file, planes, 1), 1);
  const int64_t chunks = std::max<int64_t>(int64_t(bytes_at_once / row) / chunk, 1);
  return int(std::min<int64_t>(chunks * chunk, file.window.height()));
}

}  // namespace gloam
