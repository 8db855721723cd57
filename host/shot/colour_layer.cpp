#include "shot/colour_layer.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "exr/channel_sums.h"
#include "exr/cryptomatte.h"
#include "exr/holdings.h"
#include "frame/untouched.h"
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
  leave_out_other_light(colour, notes);
  return colour;
}

std::map<std::string, std::string> names_of_light(const FrameFiles& files) {
  std::map<std::string, std::string> names;
  for (const FrameFile& file : files.files()) {
    for (const PlaneSource& source : file.planes())
      if (contains(planes_of_darkened_light(), source.plane)) names.emplace(source.plane, layers_in_words(source));
  }
  return names;
}

std::vector<std::string> notes_on_darkening(const ColourLayer& layer, const Frame& colour) {
  const std::map<std::string, std::string> names = names_of_light(layer.files);
  const std::vector<std::string> planes = common_planes(colour), untouched = untouched_of(planes);
  std::vector<std::string> notes;
  if (has_illumination(planes)) notes.push_back(note_on_illumination(names));
  if (!untouched.empty()) notes.push_back(note_on_untouched(untouched, names));
  return notes;
}

std::vector<std::string> notes_on_cryptomattes(const std::filesystem::path& file) {
  std::vector<std::string> notes;
  for (const Cryptomatte& each : cryptomattes_of(file))
    notes.push_back(
        fmt::format("{}: this Cryptomatte is not in the composite; gloam run {} keeps it, with its attributes",
                    each.name, option("into", "COPY.exr")));
  return notes;
}

ColourLayer open_colour(const std::vector<std::string>& paths, const ReadOptions& options) {
  ReadOptions as_stored = options;
  as_stored.as_stored = true;
  ColourLayer layer{FrameFiles(paths, as_stored), {"color"}, {}, 0};
  check_colour(layer.files);
  if (contains(layer.files.common_planes(), "alpha")) layer.planes.push_back("alpha");
  const std::vector<std::string> common = layer.files.common_planes();
  add_new(layer.planes, untouched_of(common));
  if (has_illumination(common)) layer.planes.insert(layer.planes.end(), {"illumination", "albedo"});
  for (const std::string& plane : layer.planes) {
    if (is_half(layer.files, plane)) layer.half_planes.push_back(plane);
  }
  layer.part = part_of_colour(layer.files.files().front());
  return layer;
}

}  // namespace gloam
