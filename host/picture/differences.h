// The differences of a plane and its truth, as an image and as a histogram.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam {

/// The data of the picture. The drawn difference of a pixel is that of the component that differs most.
struct Differences {
  const Plane& test;
  const Plane& truth;
  const Mask& foreground;
  int width, height;
  size_t components;

  bool counts(int x, int y) const { return foreground[size_t(y) * size_t(width) + size_t(x)] != 0; }
  double of_component(size_t c, int x, int y) const {
    const double d = double(test.channels[c].at(x, y)) - double(truth.channels[c].at(x, y));
    return std::isfinite(d) ? d : 0;
  }
  double at(int x, int y) const {
    double largest = 0;
    for (size_t c = 0; c < components; ++c) {
      const double d = of_component(c, x, y);
      if (std::abs(d) > std::abs(largest)) largest = d;
    }
    return largest;
  }
};

/// Throws Error for planes of different size or components, and for a mask of another size.
Differences differences(const Plane& test, const Plane& truth, const Mask& foreground);

/// End of a scale: the smallest of 0.05, 0.1, 0.2, 0.5 and 1 that covers 99 % of the counted pixels.
float fitting_range(const Differences& d);

/// Colour of a difference in units of the scale's end; beyond -1 and 1, that of the end.
cv::Vec3b difference_colour(double t);

/// CV_8UC3, with `range` at the ends of the colours; pixels that do not count have the colour of no difference.
cv::Mat difference_image(const Differences& d, double range);

/// Histogram of the differences of all components.
struct Histogram {
  std::vector<long long> bins;  ///< of equal width over -range .. range; an odd number: the middle one is about 0
  long long largest = 0;
  long long beyond = 0, all = 0;  ///< values outside the range (also in the end bins); all values
};

Histogram histogram_of(const Differences& d, double range, int bins);

}  // namespace gloam
