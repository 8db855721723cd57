#include "normalise/normalise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.h"
#include "gloam/planes.h"
#include "normalise/background.h"
#include "normalise/each_row.h"
#include "normalise/radiance.h"
#include "normalise/surfaces.h"

namespace gloam {

namespace {

/// Pixels of a row that are made unit together.
constexpr int at_once = 64;

/// Squared lengths of normals. Returns how many of them are unit but for rounding.
int near_unit(const float* x, const float* y, const float* z, int count, double* squares) {
  for (int i = 0; i < count; ++i) {
    const double a = x[i], b = y[i], c = z[i];
    squares[i] = a * a + b * b + c * c;  // in double no float overflows or vanishes
  }
  int near = 0;
  for (int i = 0; i < count; ++i) near += std::abs(squares[i] - 1) < 3e-7;
  return near;
}

void make_unit(float* x, float* y, float* z, int count, const double* squares) {
  for (int i = 0; i < count; ++i) {
    const double square = squares[i], inverse = 1 / std::sqrt(square);
    const bool usable = (square > 0) & (square < std::numeric_limits<double>::infinity());
    // Normals that are unit but for rounding stay as they are, so that a second pass changes no bit.
    const double unit = std::abs(square - 1) < 3e-7 ? 1.0 : inverse;
    x[i] = usable ? float(x[i] * unit) : 0.0f;
    y[i] = usable ? float(y[i] * unit) : 0.0f;
    z[i] = usable ? float(z[i] * unit) : 0.0f;
  }
}

void clear_background(float* row, const float* depth, int width) {
  for (int i = 0; i < width; ++i) row[i] = depth[i] < infinity ? row[i] : 0.0f;
}

/// `depth`, if given, marks the background. Mostly all normals are unit already, and no root is taken.
void unit_row(float* x, float* y, float* z, const float* depth, int width) {
  double squares[at_once];
  for (int first = 0; first < width; first += at_once) {
    const int count = std::min(at_once, width - first);
    if (near_unit(x + first, y + first, z + first, count, squares) == count) continue;
    make_unit(x + first, y + first, z + first, count, squares);
  }
  if (!depth) return;
  for (float* row : {x, y, z}) clear_background(row, depth, width);
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

using CleanRow = std::function<void(int y)>;

/// What makes a row of a plane clean. NaN where a value is clamped to 0..1 becomes the value outside the image: open for AO, rough, black
/// for albedo.
CleanRow cleaner_of(Plane& plane, const PlaneKind& kind, const Plane* depth, const Background& background) {
  std::vector<Channel>& channels = plane.channels;
  const int width = channels.front().layout().width;
  if (kind.meaning == PlaneKind::unit_vector && channels.size() == 3)
    return [&channels, depth, width](int y) {
      unit_row(channels[0].row(y), channels[1].row(y), channels[2].row(y), depth ? depth->channels[0].row(y) : nullptr,
               width);
    };
  return [&channels, meaning = kind.meaning, outside = kind.outside, background, width](int y) {
    for (Channel& channel : channels) {
      if (meaning == PlaneKind::view_depth)
        clean_depth_row(channel.row(y), width, 1, background);
      else if (meaning == PlaneKind::unit_interval)
        clamp_row(channel.row(y), width, outside);
      else
        finite_row(channel.row(y), width);
    }
  };
}

Background background_in(const View& view, std::optional<float> value) {
  return background_of(value, view.camera ? view.camera->far : std::nullopt);
}

Plane* depth_of(View& view) {
  const auto found = view.planes.find("depth");
  return found == view.planes.end() || found->second.channels.empty() ? nullptr : &found->second;
}

/// All planes of a view, the depth first if it is wanted: it marks the background of the normals. `as_stored`: only depths.
std::vector<CleanRow> cleaners_of(View& view, const Background& background, bool as_stored, bool with_depth) {
  Plane* const depth = depth_of(view);
  std::vector<CleanRow> cleaners;
  if (depth && with_depth) cleaners.push_back(cleaner_of(*depth, plane_kind("depth"), nullptr, background));
  for (auto& [name, plane] : view.planes) {
    const PlaneKind kind = plane_kind(name);
    if (&plane != depth && !plane.channels.empty() && (!as_stored || kind.meaning == PlaneKind::view_depth))
      cleaners.push_back(cleaner_of(plane, kind, depth, background));
  }
  return cleaners;
}

void fill_paddings(View& view) {
  for (auto& [name, plane] : view.planes) {
    const float outside = plane_kind(name).outside;
    for (Channel& channel : plane.channels) channel.fill_padding(outside);
  }
}

/// The layout of a view's planes; an empty one without a plane.
Layout layout_of(const View& view) {
  for (const auto& [name, plane] : view.planes) {
    if (!plane.channels.empty()) return plane.channels.front().layout();
  }
  return {};
}

void clean_rows(const std::vector<CleanRow>& cleaners, const Layout& layout) {
  for_each_row(layout, [&](int y) {
    for (const CleanRow& clean : cleaners) clean(y);
  });
}

}  // namespace

void normalise_planes(Frame& frame, std::optional<float> background, bool as_stored) {
  for (View& view : frame.views) {
    clean_rows(cleaners_of(view, background_in(view, background), as_stored, false), layout_of(view));
    fill_paddings(view);
  }
}

void normalise(Frame& frame, std::optional<float> background) {
  LightCounts light;
  for (View& view : frame.views) {
    light.add(view, view.find("depth"));
    clean_rows(cleaners_of(view, background_in(view, background), false, true), layout_of(view));
    fill_paddings(view);
    add_new(frame.assumed, notes_on_agreement(view, frame.window));
  }
  add_new(frame.assumed, light.notes());
}

void normalise_while_filling(View& view, const Layout& layout, const std::function<void(int y)>& fill,
                             std::optional<float> background) {
  std::vector<CleanRow> steps = {fill};
  for (CleanRow& clean : cleaners_of(view, background_in(view, background), false, true))
    steps.push_back(std::move(clean));
  clean_rows(steps, layout);
  fill_paddings(view);
}

}  // namespace gloam
