#include "gloam/composite.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Calls `change(colour, effect)` for each pixel of a channel.
template <typename Change>
void change_pixels(Channel& colour, const Channel& effect, const Change& change) {
  const Layout& layout = colour.layout();
  if (layout != effect.layout())
    throw Error("the colour is {} x {}, and the result {} x {}", layout.width, layout.height, effect.layout().width,
                effect.layout().height);
  for (int y = 0; y < layout.height; ++y) {
    float* to = colour.row(y);
    const float* from = effect.row(y);
    for (int x = 0; x < layout.width; ++x) change(to[x], from[x]);
  }
}

void darken(Channel& colour, const Channel& ao, double strength, double tint) {
  change_pixels(colour, ao, [&](float& value, float open) {
    const double share = std::max(0.0, 1 - strength * (1 - double(open)) * (1 - tint));
    if (share != 1) value = float(value * share);
  });
}

void add(Channel& colour, const Channel& reflection, double strength) {
  change_pixels(colour, reflection, [&](float& value, float more) {
    if (const double added = strength * double(more); added != 0) value = float(value + added);
  });
}

}  // namespace

std::string composited_plane(const std::vector<std::string>& planes) {
  const std::vector<std::string> known = {"ao", "ao_raw", "reflection"};
  const auto found =
      std::find_if(planes.begin(), planes.end(), [&](const std::string& plane) { return contains(known, plane); });
  return found == planes.end() ? "" : *found;
}

void composite(Frame& colour, const Frame& result, const std::string& plane, const Compositing& how) {
  for (View& view : colour.views) {
    Plane& color = view.planes.at("color");
    const Plane* effect = result.view(view.name).find(plane);
    if (!effect) throw Error("the result has no '{}'", plane);
    for (size_t i = 0; i < color.channels.size(); ++i) {
      if (plane == "reflection")
        add(color.channels[i], effect->channels[i], how.strength);
      else
        darken(color.channels[i], effect->channels.front(), how.strength, how.tint[i]);
    }
  }
}

}  // namespace gloam
