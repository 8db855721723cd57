#include "measures.h"

#include <algorithm>
#include <cmath>

#include "timing.h"

namespace gloam::bench {
namespace {

/// Mean of a function of test - truth over the foreground; 0 where there is none.
template <typename Function>
double mean_over(const Image& test, const Image& truth, const std::vector<Mask>& foreground, Function function) {
  double sum = 0;
  long long count = 0;
  for (size_t i = 0; i < foreground.size(); ++i) {
    const Channel &a = test.at(i).channels[0], &b = truth.at(i).channels[0];
    const int width = a.layout().width, height = a.layout().height;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!foreground[i][size_t(y) * size_t(width) + size_t(x)]) continue;
        sum += function(double(a.at(x, y)) - double(b.at(x, y)));
        ++count;
      }
    }
  }
  return count == 0 ? 0 : sum / double(count);
}

}  // namespace

std::vector<Mask> foreground(const Frame& frame) {
  std::vector<Mask> masks;
  for (const View& view : frame.views) {
    const Channel& depth = view.planes.at("depth").channels[0];
    Mask& mask = masks.emplace_back();
    mask.reserve(size_t(frame.width()) * size_t(frame.height()));
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) mask.push_back(!is_background(depth.at(x, y)));
    }
  }
  return masks;
}

double rmse(const Image& test, const Image& truth, const std::vector<Mask>& foreground) {
  return std::sqrt(mean_over(test, truth, foreground, [](double d) { return d * d; }));
}

double bias(const Image& test, const Image& truth, const std::vector<Mask>& foreground) {
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

double median_reach(const Frame& frame, double radius) {
  const View& view = frame.views.front();
  if (!view.camera || !view.find("depth")) return 0;
  const double depth = median_depth(view);
  if (depth == 0) return 0;
  return radius * view.camera->fx / (view.camera->orthographic ? 1 : depth);
}

}  // namespace gloam::bench
