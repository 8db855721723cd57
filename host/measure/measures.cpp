#include "measure/measures.h"

#include <algorithm>
#include <cmath>

#include "gloam/margin.h"
#include "gloam/radius.h"
#include "measure/timing.h"

namespace gloam::bench {
namespace {

/// Mean of a function of test - truth over the foreground; 0 if there is none.
template <typename Function>
double mean_over(const Image& test, const Image& truth, const Foreground& foreground, Function function) {
  double sum = 0;
  long long count = 0;
  for (const auto& [view, mask] : foreground) {
    const auto tested = test.find(view), expected = truth.find(view);
    if (tested == test.end() || expected == truth.end()) continue;
    const std::vector<Channel>&a = tested->second.channels, &b = expected->second.channels;
    const int width = a[0].layout().width, height = a[0].layout().height;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          if (!mask[size_t(y) * size_t(width) + size_t(x)]) continue;
          sum += function(double(a[i].at(x, y)) - double(b[i].at(x, y)));
          ++count;
        }
      }
    }
  }
  return count == 0 ? 0 : sum / double(count);
}

}  // namespace

Foreground foreground(const Frame& frame, bool first_view_only) {
  Foreground masks;
  const Window picture = picture_within(frame.window, frame.display);
  const auto is_shown = [&](int x, int y) {
    const int at_x = x + frame.window.x0, at_y = y + frame.window.y0;
    return at_x >= picture.x0 && at_x < picture.x1 && at_y >= picture.y0 && at_y < picture.y1;
  };
  for (const View& view : frame.views) {
    const Channel& depth = view.planes.at("depth").channels[0];
    if (first_view_only && !masks.empty()) break;
    Mask& mask = masks[view.name];
    mask.reserve(size_t(frame.width()) * size_t(frame.height()));
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) mask.push_back(is_shown(x, y) && !is_background(depth.at(x, y)));
    }
  }
  return masks;
}

Image image_of(Frame frame, const std::string& plane) {
  Image image;
  for (View& view : frame.views) {
    if (const auto made = view.planes.find(plane); made != view.planes.end())
      image.emplace(view.name, std::move(made->second));
  }
  return image;
}

Image even_image(const Image& like, float value) {
  Image image;
  for (const auto& [view, plane] : like) {
    Plane& even = image.emplace(view, Plane{plane.name, {}}).first->second;
    for (const Channel& channel : plane.channels) even.channels.emplace_back(channel.layout(), value);
  }
  return image;
}

double rmse(const Image& test, const Image& truth, const Foreground& foreground) {
  return std::sqrt(mean_over(test, truth, foreground, [](double d) { return d * d; }));
}

double bias(const Image& test, const Image& truth, const Foreground& foreground) {
  return mean_over(test, truth, foreground, [](double d) { return d; });
}

double mean_difference(const Channel& a, const Channel& b) {
  const Layout& layout = a.layout();
  double sum = 0;
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) sum += std::abs(double(a.at(x, y)) - double(b.at(x, y)));
  }
  return sum / (double(layout.width) * layout.height);
}

double greatest_difference(const Channel& a, const Channel& b) {
  const Layout& layout = a.layout();
  double greatest = 0;
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x)
      greatest = std::max(greatest, std::abs(double(a.at(x, y)) - double(b.at(x, y))));
  }
  return greatest;
}

double median_depth(const View& view) {
  const Channel& depth = view.planes.at("depth").channels[0];
  std::vector<double> depths;
  for (int y = 0; y < depth.layout().height; ++y) {
    for (int x = 0; x < depth.layout().width; ++x) {
      if (!is_background(depth.at(x, y))) depths.push_back(depth.at(x, y));
    }
  }
  return median(std::move(depths));
}

double median_reach(const Frame& frame, double radius) { return radius * pixels_at_median_depth(frame).value_or(0); }

}  // namespace gloam::bench
