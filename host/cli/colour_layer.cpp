#include "cli/colour_layer.h"

#include <algorithm>

#include "cli/options.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

void check_colour(const FrameFiles& files) {
  if (contains(files.common_planes(), "color")) return;
  const std::string why = files.why_missing("color");
  throw Error("--composite: {}; --plane color=LAYER or color=R,G,B names the colour",
              why.empty() ? fmt::format("no channel is known as the frame's colour, and {}", holdings(files))
                          : fmt::format("in {} {}", files.name(), why));
}

bool is_half(const FrameFiles& files, const std::string& plane) {
  for (const FrameFile& file : files.files()) {
    for (const PlaneSource& source : file.planes()) {
      if (source.plane != plane) continue;
      const auto half = [](const ChannelSource& channel) { return channel.type == "half"; };
      if (!std::all_of(source.channels.begin(), source.channels.end(), half)) return false;
    }
  }
  return true;
}

int part_of_colour(const FrameFile& file) {
  for (const PlaneSource& source : file.planes())
    if (source.plane == "color") return source.channels.front().part;
  return 0;
}

}  // namespace

ColourLayer open_colour(const std::vector<std::string>& paths, const ReadOptions& options) {
  ReadOptions as_stored = options;
  as_stored.as_stored = true;
  ColourLayer layer{FrameFiles(paths, as_stored), {"color"}, {}, 0};
  check_colour(layer.files);
  if (contains(layer.files.common_planes(), "alpha")) layer.planes.push_back("alpha");
  for (const std::string& plane : layer.planes) {
    if (is_half(layer.files, plane)) layer.half_planes.push_back(plane);
  }
  layer.part = part_of_colour(layer.files.files().front());
  return layer;
}

}  // namespace gloam::cli
