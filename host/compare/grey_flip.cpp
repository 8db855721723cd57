#include "compare/grey_flip.h"

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

#include "base/srgb.h"
#include "compare/flip.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Rows [first, last) in linear light.
cv::Mat grey_rows(const Channel& channel, const Mask& foreground, int first, int last) {
  const int width = channel.layout().width;
  cv::Mat rows(last - first, width, CV_32F);
  for (int y = first; y < last; ++y) {
    float* out = rows.ptr<float>(y - first);
    for (int x = 0; x < width; ++x) {
      const bool counts = foreground[size_t(y) * size_t(width) + size_t(x)] != 0;
      out[x] = counts ? float(linear_of_srgb(std::clamp(double(channel.at(x, y)), 0.0, 1.0))) : 1;
    }
  }
  return rows;
}

/// Sum of the map over the foreground of rows [y0, y1).
double sum_of_rows(const Channel& test, const Channel& truth, const Mask& foreground, int y0, int y1) {
  const Layout& layout = test.layout();
  const int first = std::max(y0 - flip_reach(), 0), last = std::min(y1 + flip_reach(), layout.height);
  const cv::Mat map =
      grey_flip_map(grey_rows(test, foreground, first, last), grey_rows(truth, foreground, first, last));
  double sum = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (foreground[size_t(y) * size_t(layout.width) + size_t(x)]) sum += map.at<double>(y - first, x);
    }
  }
  return sum;
}

}  // namespace

double grey_flip(const Plane& test, const Plane& truth, const Mask& foreground) {
  const Layout &layout = test.channels.at(0).layout(), &other = truth.channels.at(0).layout();
  if (!(layout == other) || foreground.size() != size_t(layout.width) * size_t(layout.height))
    throw Error("'{}' cannot be compared: the test is {}x{} and the truth is {}x{}", test.name, layout.width,
                layout.height, other.width, other.height);
  // Some rows at once, each by one thread; their sums are added in order, so that threads change no bit.
  constexpr int band = 64;
  const int bands = (layout.height + band - 1) / band;
  std::vector<double> sums(size_t(bands), 0.0);
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < bands; ++i)
    sums[size_t(i)] =
        sum_of_rows(test.channels[0], truth.channels[0], foreground, i * band, std::min((i + 1) * band, layout.height));
  const auto count = std::count_if(foreground.begin(), foreground.end(), [](unsigned char m) { return m != 0; });
  return count > 0 ? std::accumulate(sums.begin(), sums.end(), 0.0) / double(count) : 0;
}

}  // namespace gloam
