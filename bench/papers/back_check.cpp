#include "papers/back_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "papers/eyes.h"

namespace gloam::bench {
namespace {

/// RMSE of one plane to another over pixels that `counts`.
double error_where(const Mask& counts, const Channel& test, const Channel& truth) {
  const int width = truth.layout().width;
  double squares = 0, count = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (!counts[i]) continue;
    const int x = int(i) % width, y = int(i) / width;
    const double difference = double(test.at(x, y)) - double(truth.at(x, y));
    squares += difference * difference;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Pixels at which a is farther from the truth than b.
Mask where_worse(const Channel& a, const Channel& b, const Channel& truth) {
  Mask worse;
  for (int y = 0; y < a.layout().height; ++y) {
    for (int x = 0; x < a.layout().width; ++x)
      worse.push_back(std::abs(a.at(x, y) - truth.at(x, y)) > std::abs(b.at(x, y) - truth.at(x, y)));
  }
  return worse;
}

constexpr int parts = 16;  ///< parts of the image's width and height

Window part_of(const Layout& layout, int column, int row) {
  const int x = column * layout.width / parts, y = row * layout.height / parts;
  return {x, y, x + std::max(layout.width / parts, 1), y + std::max(layout.height / parts, 1)};
}

/// The part of the image that holds the most of the mask.
Window fullest_part(const Mask& mask, const Layout& layout) {
  Window fullest = part_of(layout, 0, 0);
  long long most = 0;
  for (int i = 0; i < parts * parts; ++i) {
    const Window w = part_of(layout, i % parts, i / parts);
    long long count = 0;
    for (int y = w.y0; y < w.y1; ++y) {
      const auto row = mask.begin() + long(y) * layout.width;
      count += std::count(row + w.x0, row + w.x1, 1);
    }
    if (count <= most) continue;
    most = count;
    fullest = w;
  }
  return fullest;
}

/// Cuts out a window; each pixel becomes a square.
Plane cut_out(const Plane& plane, const Window& w) {
  constexpr int enlarged = 4;
  Plane part{plane.name, {}};
  Channel& channel = part.channels.emplace_back(Layout(enlarged * w.width(), enlarged * w.height()), 1.0f);
  for (int y = 0; y < channel.layout().height; ++y) {
    for (int x = 0; x < channel.layout().width; ++x)
      channel.at(x, y) = plane.channels[0].at(w.x0 + x / enlarged, w.y0 + y / enlarged);
  }
  return part;
}

void state_worse(Study& study, const std::string& figure, const std::string& scene, const std::string& name,
                 const Mask& worse, const Channel& ao, const Channel& own) {
  study.fact(figure + ": where that alone is off what each eye finds by itself", name, scene,
             1e5 * double(std::count(worse.begin(), worse.end(), 1)) / double(worse.size()), "pixels of 100 000");
  study.fact(figure + ": by how much it is off there", name, scene, error_where(worse, ao, own), "RMSE, unfiltered");
}

}  // namespace

void figure_5(Study& study, const Stage& s, const std::string& scene, const Asked& raw, const Asked& filtered) {
  const std::string figure = fmt::format("Figure 5, {}: reprojection with and without the back-check", size_of(s)),
                    right = s.frame.views[1].name;
  const std::array<std::string, 3> names = {"reproject=no-back-check", "reproject=on", "reproject=off"};
  std::vector<Image> images;
  for (const char* choice : {"no-back-check", "on", "off"}) {
    images.push_back(study.images(s, with(raw, "reproject", choice)));
    const Image ao = study.images(s, with(filtered, "reproject", choice));
    study.fact(figure, names[images.size() - 1], scene, in_hundred_thousandths(inconsistency(s, ao).both),
               inconsistency_unit);
  }
  const auto ao = [&](size_t i) -> const Channel& { return images[i].at(right).channels[0]; };
  const Mask unchecked_is_worse = where_worse(ao(0), ao(1), ao(2)), checked_is_worse = where_worse(ao(1), ao(0), ao(2));
  state_worse(study, figure, scene, names[0], unchecked_is_worse, ao(0), ao(2));
  state_worse(study, figure, scene, names[1], checked_is_worse, ao(1), ao(2));
  const Window shown = fullest_part(unchecked_is_worse, ao(0).layout());
  std::vector<Panel> panels;
  for (size_t i = 0; i < names.size(); ++i) panels.push_back({names[i], cut_out(images[i].at(right), shown)});
  study.picture(fmt::format("Figure 5: {}", scene),
                "Unfiltered AO of the right eye, from the part of the image where the back-check is worth most.",
                fmt::format("figure_5_{}.png", scene), panels, 3);
}

}  // namespace gloam::bench
