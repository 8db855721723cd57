#include "shot/colour_layer.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

void check_colour(const FrameFiles& files) {
  if (contains(files.common_planes(), "color")) return;
  const std::string why = files.why_missing("color");
  throw Error("{}: {}; {} or {} names the colour", option("composite"),
              why.empty() ? fmt::format("no channel is known as the frame's colour, and {}", holdings(files))
                          : fmt::format("in {} {}", files.name(), why),
              channels_option("color", "LAYER"), channels_option("color", "R,G,B"));
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

/// Whether a pixel of the colour is infinite or NaN.
bool is_no_light(const Plane& color, int x, int y) {
  return std::any_of(color.channels.begin(), color.channels.end(),
                     [&](const Channel& channel) { return !std::isfinite(channel.at(x, y)); });
}

long long count_no_light(const Frame& frame) {
  long long count = 0;
  for (const View& view : frame.views) {
    const Plane& color = view.planes.at("color");
#pragma omp parallel for reduction(+ : count)
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) count += is_no_light(color, x, y);
    }
  }
  return count;
}

}  // namespace

Frame read_layer(ColourLayer& layer, std::vector<std::string>& notes) {
  Frame colour = layer.files.read(layer.planes);
  if (const long long count = count_no_light(colour); count > 0)
    notes.push_back(fmt::format("color: {} pixel{} {} infinite or NaN, and the composite keeps {}", count,
                                count == 1 ? "" : "s", count == 1 ? "is" : "are", count == 1 ? "it" : "them"));
  return colour;
}

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

}  // namespace gloam
