#include "exr/fills.h"

#include <algorithm>
#include <array>

#include "base/lists.h"
#include "frame/unfit.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// A value that stands for none.
struct Fill {
  const char* plane;
  const char* channel;  ///< part of the channel's name; empty: any
  float value;
  double least_share;  ///< of the surfaces
  const char* why;     ///< "{}": the share in percent
};

constexpr std::array<Fill, 2> fills = {{
    {"reflectance", "GlossCol", 1, 0.5,
     "GlossCol is 1 on {:.0f} % of the surfaces, as a Principled BSDF writes it for any material, and reflections "
     "would "
     "be far too bright (--plane reflectance=none takes 0.04)"},
    // A truthful frame may show some mirrors, but not mirrors alone.
    {"roughness", "", 0, 0.999,
     "it is 0 on {:.0f} % of the surfaces, as an output that no material fills, and all would be perfect mirrors"},
}};

const Fill& fill_of(const std::string& plane) {
  return *std::find_if(fills.begin(), fills.end(), [&](const Fill& fill) { return fill.plane == plane; });
}

}  // namespace

Fills::Fills(const ExrFile& file, const std::string& view) {
  for (const Fill& fill : fills) {
    const PlaneSource* source = file.source(fill.plane, view);
    if (!source || source->channels.empty() || file.options.channels.contains(fill.plane)) continue;
    if (source->channels.front().name.find(fill.channel) == std::string::npos) continue;
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
      add_new(frame.assumed, note_on({plane, fmt::format(fmt::runtime(fill.why), 100 * count.share())}));
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
