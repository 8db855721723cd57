#include "picture/tile.h"

#include <array>
#include <cmath>
#include <limits>

#include "gloam/planes.h"

namespace gloam {
namespace {

struct NamedStyle {
  const char* plane;
  size_t components;
  PictureStyle style;
};

/// Planes whose kind does not determine the style. A plane with another number of components is drawn by those.
constexpr std::array<NamedStyle, 5> named_styles{{{"instance", 1, PictureStyle::identity},
                                                  {"peel_count", 1, PictureStyle::count},
                                                  {"outline_count", 1, PictureStyle::count},
                                                  {"position", 3, PictureStyle::position},
                                                  {"motion", 2, PictureStyle::motion}}};

PictureStyle style_of(const Plane& plane) {
  const size_t components = plane.channels.size();
  for (const NamedStyle& named : named_styles)
    if (plane.name == named.plane && components == named.components) return named.style;
  const PlaneKind::Meaning meaning = plane_kind(plane.name).meaning;
  if (components > 1) return meaning == PlaneKind::unit_vector ? PictureStyle::direction : PictureStyle::colour;
  if (meaning == PlaneKind::view_depth) return PictureStyle::depth;
  return meaning == PlaneKind::unit_interval ? PictureStyle::share : PictureStyle::scalar;
}

/// Whether background pixels have a value: the sky has a colour and a coverage.
bool background_has_value(const Plane& plane) { return plane.name == "color" || plane.name == "alpha"; }

const Channel* background_of(const View& view, const Plane& plane, PictureStyle style) {
  if (style == PictureStyle::depth) return &plane.channels[0];
  const Plane* depth = view.find("depth");
  return depth && !depth->channels.empty() && !background_has_value(plane) ? &depth->channels[0] : nullptr;
}

}  // namespace

Tile tile_of(const View& view, const Plane& plane) {
  const PictureStyle style = style_of(plane);
  return {&view, &plane, style, background_of(view, plane, style)};
}

double value_at(const Tile& tile, size_t component, int x, int y) {
  const Plane& plane = *tile.plane;
  const double v = plane.channels[component].at(x, y);
  if (tile.style == PictureStyle::depth) return v > 0 ? std::log(v) : std::numeric_limits<double>::quiet_NaN();
  if (tile.style == PictureStyle::motion) return std::hypot(v, double(plane.channels[1].at(x, y)));
  return v;
}

size_t components_of(const Tile& tile) { return tile.style == PictureStyle::motion ? 1 : tile.plane->channels.size(); }

bool is_finite(const Tile& tile, int x, int y) {
  if (tile.style == PictureStyle::depth) {  // a depth is drawn by its logarithm
    const float depth = tile.plane->channels[0].at(x, y);
    return depth > 0 && std::isfinite(depth);
  }
  for (size_t c = 0; c < components_of(tile); ++c)
    if (!std::isfinite(value_at(tile, c, x, y))) return false;
  return true;
}

cv::Mat background_mask(const Tile& tile) {
  cv::Mat mask(tile.layout().height, tile.layout().width, CV_8UC1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) mask.at<unsigned char>(y, x) = tile.is_background(x, y) ? 255 : 0;
  return mask;
}

Sampling sampling_of(const Tile& tile) {
  return tile.style == PictureStyle::identity ? Sampling::point : Sampling::average;
}

}  // namespace gloam
