#include "gloam/composite.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/lists.h"
#include "frame/untouched.h"
#include "gloam/error.h"

namespace gloam {
namespace {

void check_same_layout(const Channel& colour, const Channel& effect) {
  const Layout& layout = colour.layout();
  if (layout != effect.layout())
    throw Error("the colour is {} x {}, and the result {} x {}", layout.width, layout.height, effect.layout().width,
                effect.layout().height);
}

/// Calls `change(colour, effect)` for each pixel of a channel.
template <typename Change>
void change_pixels(Channel& colour, const Channel& effect, const Change& change) {
  check_same_layout(colour, effect);
  const Layout& layout = colour.layout();
  for (int y = 0; y < layout.height; ++y) {
    float* to = colour.row(y);
    const float* from = effect.row(y);
    for (int x = 0; x < layout.width; ++x) change(to[x], from[x]);
  }
}

double share_left(float open, double strength, double tint) {
  return std::max(0.0, 1 - strength * (1 - double(open)) * (1 - tint));
}

void darken(Channel& colour, const Channel& ao, double strength, double tint) {
  change_pixels(colour, ao, [&](float& value, float open) {
    const double share = share_left(open, strength, tint);
    if (share != 1) value = float(value * share);
  });
}

/// Darkens a part of the colour. What would not be finite stays as it is.
void darken_part(Channel& colour, const Channel& ao, const DarkenedLight& light, double strength, double tint) {
  std::vector<float> part(size_t(colour.layout().width));
  check_same_layout(colour, ao);
  for (int y = 0; y < colour.layout().height; ++y) {
    float* to = colour.row(y);
    light.darkened(y, to, part.data());
    for (int x = 0; x < colour.layout().width; ++x) {
      const double darkened = double(part[size_t(x)]), share = share_left(ao.row(y)[x], strength, tint);
      const float value = float(double(to[x]) - darkened + darkened * share);
      if (share != 1 && darkened != 0 && std::isfinite(value)) to[x] = value;
    }
  }
}

/// A component of a view's colour: of what occlusion darkens.
void darken(View& view, size_t component, const Channel& ao, const Compositing& how) {
  Channel& colour = view.planes.at("color").channels[component];
  const DarkenedLight light(view, component);
  if (light.is_all())
    darken(colour, ao, how.strength, how.tint[component]);
  else
    darken_part(colour, ao, light, how.strength, how.tint[component]);
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
        darken(view, i, effect->channels.front(), how);
    }
  }
}

}  // namespace gloam
