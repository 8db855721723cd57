#include "normalise/normalise.h"

#include <cmath>
#include <limits>

#include "gloam/planes.h"
#include "normalise/background.h"
#include "normalise/each_row.h"

namespace gloam {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// `depth`, if given, marks the background.
void unit_row(float* x, float* y, float* z, const float* depth, int width) {
  for (int i = 0; i < width; ++i) {
    const double a = x[i], b = y[i], c = z[i];
    const double square = a * a + b * b + c * c;  // in double no float overflows or vanishes
    const double inverse = 1 / std::sqrt(square);
    // Normals that are unit but for rounding stay as they are, so that a second pass changes no bit.
    const double unit = std::abs(square - 1) < 3e-7 ? 1.0 : inverse;
    const bool usable = (square > 0) & (square < std::numeric_limits<double>::infinity());
    const bool keep = usable & (depth ? depth[i] < infinity : true);
    x[i] = keep ? float(a * unit) : 0.0f;
    y[i] = keep ? float(b * unit) : 0.0f;
    z[i] = keep ? float(c * unit) : 0.0f;
  }
}

void make_unit(Plane& plane, const Plane* depth) {
  const Layout& layout = plane.channels[0].layout();
  for_each_row(layout, [&](int y) {
    unit_row(plane.channels[0].row(y), plane.channels[1].row(y), plane.channels[2].row(y),
             depth ? depth->channels[0].row(y) : nullptr, layout.width);
  });
}

void clamp_row(float* row, int width, float unknown) {
  for (int x = 0; x < width; ++x) {
    const float value = row[x] == row[x] ? row[x] : unknown, positive = value > 0 ? value : 0.0f;
    row[x] = positive < 1 ? positive : 1.0f;
  }
}

void finite_row(float* row, int width) {
  for (int x = 0; x < width; ++x) row[x] = std::abs(row[x]) < infinity ? row[x] : 0.0f;
}

/// Clamps to 0..1. NaN becomes the value outside the image: open for AO, rough, black for albedo.
void clamp_channel(Channel& channel, float unknown) {
  for_each_row(channel.layout(), [&](int y) { clamp_row(channel.row(y), channel.layout().width, unknown); });
}

void make_finite(Channel& channel) {
  for_each_row(channel.layout(), [&](int y) { finite_row(channel.row(y), channel.layout().width); });
}

void clean_plane(Plane& plane, const PlaneKind& kind, const Plane* depth, const Background& background) {
  if (kind.meaning == PlaneKind::unit_vector && plane.channels.size() == 3) {
    make_unit(plane, depth);
    return;
  }
  for (Channel& channel : plane.channels) {
    if (kind.meaning == PlaneKind::view_depth)
      clean_depth(channel, 1, background);
    else if (kind.meaning == PlaneKind::unit_interval)
      clamp_channel(channel, kind.outside);
    else
      make_finite(channel);
  }
}

Background background_in(const View& view, std::optional<float> value) {
  return background_of(value, view.camera ? view.camera->far : std::nullopt);
}

Plane* depth_of(View& view) {
  const auto found = view.planes.find("depth");
  return found == view.planes.end() || found->second.channels.empty() ? nullptr : &found->second;
}

/// Normalises all planes but the depth, which marks the background of the normals.
void normalise_view(View& view, const Background& background, bool as_stored) {
  const Plane* depth = depth_of(view);
  for (auto& [name, plane] : view.planes) {
    const PlaneKind kind = plane_kind(name);
    if (&plane != depth && (!as_stored || kind.meaning == PlaneKind::view_depth))
      clean_plane(plane, kind, depth, background);
    for (Channel& channel : plane.channels) channel.fill_padding(kind.outside);
  }
}

}  // namespace

void normalise_planes(Frame& frame, std::optional<float> background, bool as_stored) {
  for (View& view : frame.views) normalise_view(view, background_in(view, background), as_stored);
}

void normalise(Frame& frame, std::optional<float> background) {
  for (View& view : frame.views) {
    if (Plane* depth = depth_of(view)) clean_depth(depth->channels[0], 1, background_in(view, background));
  }
  normalise_planes(frame, background);
}

}  // namespace gloam
