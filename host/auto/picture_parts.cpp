#include "auto/picture_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "auto/changes.h"
#include "auto/weighing.h"
#include "base/lists.h"
#include "gloam/margin.h"

namespace gloam {
namespace {

/// A part has this share of the image's width and height.
constexpr double side_of_part = 1.0 / 3;

/// Sums of squares over everything left of and above a pixel.
std::vector<double> sums_of_squares(const Channel& values) {
  const int width = values.layout().width, height = values.layout().height, row = width + 1;
  std::vector<double> sums(size_t(row) * size_t(height + 1));
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    for (int x = 0; x < width; ++x) {
      const double value = values.at(x, y);
      sum += std::isfinite(value) ? value * value : 0;
      sums[size_t(y + 1) * size_t(row) + size_t(x + 1)] = sums[size_t(y) * size_t(row) + size_t(x + 1)] + sum;
    }
  }
  return sums;
}

/// Where the values' squares are largest in sum.
Window strongest(const Channel& values) {
  const Layout& layout = values.layout();
  const auto side = [](int whole) { return std::max(1, int(std::lround(whole * side_of_part))); };
  const int width = side(layout.width), height = side(layout.height);
  const std::vector<double> sums = sums_of_squares(values);
  const auto sum = [&](int x, int y) { return sums[size_t(y) * size_t(layout.width + 1) + size_t(x)]; };
  Window best{0, 0, width, height};
  double most = -1;
  for (int y = 0; y + height <= layout.height; ++y) {
    for (int x = 0; x + width <= layout.width; ++x) {
      const int right = x + width, bottom = y + height;
      const double here = sum(right, bottom) - sum(x, bottom) - sum(right, y) + sum(x, y);
      if (here <= most) continue;
      most = here;
      best = {x, y, right, bottom};
    }
  }
  return best;
}

/// The window of an image with `scale` times as many pixels along each side.
Window enlarged(const Window& window, int scale, const Layout& image) {
  return {window.x0 * scale, window.y0 * scale, std::min(window.x1 * scale, image.width),
          std::min(window.y1 * scale, image.height)};
}

Plane cut(const Plane& plane, const Window& window) {
  const Layout& layout = plane.channels.front().layout();
  return part_of(plane, {0, 0, layout.width, layout.height}, window);
}

std::vector<std::string> without_those_of(const std::vector<std::string>& effect, std::vector<std::string> planes) {
  std::erase_if(planes, [&](const std::string& plane) { return contains(effect, plane); });
  return planes;
}

std::vector<std::string> seen_of(std::vector<std::string> planes, const Glance& glance) {
  std::erase_if(planes, [&](const std::string& plane) { return !contains(glance.planes(), plane); });
  return planes;
}

/// The pictures have every `step`-th pixel of the frame.
PicturePart picture_part(const View& without, const View& with, int step, const Channel& changes, const Frame& frame) {
  const double width = frame.width(), height = frame.height();
  const Window small = strongest(changes),
               whole = enlarged(small, scale_of_glance(frame), Layout(frame.width(), frame.height()));
  const Window& window = step == 1 ? whole : small;
  return {whole.x0 / width,
          whole.y0 / height,
          whole.width() / width,
          whole.height() / height,
          cut(*without.find("color"), window),
          cut(*with.find("color"), window),
          step};
}

/// Takes changes and parts of an effect's planes from the pictures without it and with it, for each view.
void take_parts(Outcome& outcome, const std::vector<std::string>& planes, const Frame& without, const Frame& with,
                int step, const Frame& frame, const Glance& glance) {
  for (const View& view : frame.views) {
    const Plane& changes = outcome.changes.emplace(view.name, glance.changes_by(planes, view.name)).first->second;
    outcome.parts.emplace(
        view.name, picture_part(without.view(view.name), with.view(view.name), step, changes.channels.front(), frame));
  }
}

}  // namespace

Frame show_changes(const Frame& frame, const Glance& glance, const ComposeOptions& how, AutoResult& result) {
  std::vector<std::string> made;
  for (const std::string& plane : common_planes(result.frame))
    if (contains(part_planes(), plane)) made.push_back(plane);
  Frame picture = composed(frame, result.frame, made, how);
  for (View& view : picture.views) std::erase_if(view.planes, [](const auto& plane) { return plane.first != "color"; });
  for (Outcome& outcome : result.outcomes) {
    const Technique& technique = *outcome.decision.effect.technique;
    if (!contains(glance.planes(), technique.effect.changes)) continue;
    const std::vector<std::string> planes = planes_of(technique);
    if (outcome.runs()) {
      const Frame without = composed(frame, result.frame, without_those_of(planes, made), how);
      take_parts(outcome, planes, without, picture, 1, frame, glance);
      continue;
    }
    const std::vector<std::string> others = without_those_of(planes, seen_of(made, glance));
    std::vector<std::string> with = others;
    add_new(with, seen_of(planes, glance));
    take_parts(outcome, planes, glance.picture_of(others), glance.picture_of(with), scale_of_glance(frame), frame,
               glance);
  }
  return picture;
}

}  // namespace gloam
