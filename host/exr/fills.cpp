#include "exr/fills.h"

#include <OpenEXR/ImfHeader.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/unfit.h"

namespace gloam {
namespace {

/// A value that stands for none.
struct Fill {
  const char* plane;
  const char* name;  ///< in the channel's name or its part's, in small letters without marks; empty: any
  float value;
  double least_share;  ///< of the surfaces
  const char* why;     ///< of the share in percent, and of the option that leaves the plane out
};

constexpr std::array<Fill, 2> fills = {{
    {"reflectance", "glosscol", 1, 0.5,
     "GlossCol is 1 on {:.0f} % of the surfaces, as a Principled BSDF writes it for any material, and reflections "
     "would be far too bright ({} takes 0.04)"},
    // A truthful frame may show some mirrors, but not mirrors alone.
    {"roughness", "", 0, 0.999,
     "it is 0 on {:.0f} % of the surfaces, as an output that no material fills, and all would be perfect mirrors"},
}};

/// The names of a channel and its part, in small letters and digits: renderers write layers as either.
std::string plain_names(const ExrFile& file, const ChannelSource& channel) {
  const Imf::Header& part = file.headers.of_part(channel.part);
  std::string names = lower((part.hasName() ? part.name() + "." : "") + channel.name);
  std::erase_if(names, [](unsigned char c) { return c < 128 && !std::isalnum(c); });
  return names;
}

const Fill& fill_of(const std::string& plane) {
  return *std::find_if(fills.begin(), fills.end(), [&](const Fill& fill) { return fill.plane == plane; });
}

}  // namespace

void FilledPixels::add(const Plane& plane, const Channel& depth, int first_row) {
  const Layout& layout = plane.channels.front().layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (is_background(depth.at(x, first_row + y))) continue;
      ++surfaces;
      filled += std::all_of(plane.channels.begin(), plane.channels.end(),
                            [&](const Channel& c) { return c.at(x, y) == value; });
    }
  }
}

Fills::Fills(const ExrFile& file, const std::string& view) {
  for (const Fill& fill : fills) {
    const PlaneSource* source = file.source(fill.plane, view);
    if (!source || source->channels.empty() || file.options.channels.contains(fill.plane)) continue;
    if (plain_names(file, source->channels.front()).find(fill.name) == std::string::npos) continue;
    counts_[fill.plane].value = fill.value;
  }
}

std::vector<std::string> Fills::planes() const {
  std::vector<std::string> names;
  for (const auto& [plane, unused] : counts_) names.push_back(plane);
  return names;
}

void Fills::add(const View& rows, const Channel& depth, int first_row) {
  for (auto& [name, count] : counts_)
    if (const Plane* plane = rows.find(name)) count.add(*plane, depth, first_row);
}

void Fills::note(Frame& frame) const {
  for (const auto& [plane, count] : counts_) {
    const Fill& fill = fill_of(plane);
    if (count.surfaces > 0 && count.share() >= fill.least_share)
      add_new(
          frame.assumed,
          note_on({plane, fmt::format(fmt::runtime(fill.why), 100 * count.share(), channels_option(plane, "none"))}));
  }
}

void note_fills(const ExrFile& file, const View& view, Frame& frame) {
  const Plane* depth = view.find("depth");
  if (!depth) return;
  Fills found(file, view.name);
  found.add(view, depth->channels.front(), 0);
  found.note(frame);
}

}  // namespace gloam
