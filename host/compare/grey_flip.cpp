#include "compare/grey_flip.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/flip.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Linear light of an sRGB value.
double linear(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Rows [first, last) as three equal channels.
cv::Mat grey_rows(const Channel& channel, const Mask& foreground, int first, int last) {
  const int width = channel.layout().width;
  cv::Mat rows(last - first, width, CV_64FC3);
  for (int y = first; y < last; ++y) {
    cv::Vec3d* out = rows.ptr<cv::Vec3d>(y - first);
    for (int x = 0; x < width; ++x) {
      const bool counts = foreground[size_t(y) * size_t(width) + size_t(x)] != 0;
      out[x] = cv::Vec3d::all(counts ? linear(channel.at(x, y)) : 1.0);
    }
  }
  return rows;
}

}  // namespace

double grey_flip(const Plane& test, const Plane& truth, const Mask& foreground) {
  const Layout &layout = test.channels.at(0).layout(), &other = truth.channels.at(0).layout();
  if (!(layout == other) || foreground.size() != size_t(layout.width) * size_t(layout.height))
    throw Error("'{}' cannot be compared: the test is {}x{} and the truth is {}x{}", test.name, layout.width,
                layout.height, other.width, other.height);
  constexpr int band = 256;  // rows at once: the maps hold many images of doubles
  double sum = 0;
  long long count = 0;
  for (int y0 = 0; y0 < layout.height; y0 += band) {
    const int y1 = std::min(y0 + band, layout.height);
    const int first = std::max(y0 - flip_reach(), 0), last = std::min(y1 + flip_reach(), layout.height);
    const cv::Mat map = flip_map(grey_rows(test.channels[0], foreground, first, last),
                                 grey_rows(truth.channels[0], foreground, first, last));
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        if (!foreground[size_t(y) * size_t(layout.width) + size_t(x)]) continue;
        sum += map.at<double>(y - first, x);
        ++count;
      }
    }
  }
  return count > 0 ? sum / double(count) : 0;
}

}  // namespace gloam
