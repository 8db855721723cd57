#include "gloam/metrics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/ocl.hpp>
#include <opencv2/quality/qualitygmsd.hpp>
#include <opencv2/quality/qualityssim.hpp>

#include "compare/flip.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "picture/picture.h"

namespace gloam {
namespace {

/// Rows of the similarity maps made at a time. OpenCV holds some sixteen images of doubles per map, which for a whole
/// 8192 x 8192 frame would be 8 GiB. A multiple of 4, see `gmsd`.
constexpr int band_rows = 256;

/// SSIM's window is 11 x 11.
constexpr int ssim_reach = 5;

/// A row of the GMSD map needs its neighbours above and below, each made of two rows of the image.
constexpr int gmsd_reach = 4;

std::string size_text(const Plane& plane) {
  const size_t n = plane.channels.size();
  if (n == 0) return "nothing";
  const Layout& layout = plane.channels[0].layout();
  return fmt::format("{}x{} with {} component{}", layout.width, layout.height, n, n == 1 ? "" : "s");
}

void check_sizes(const Plane& test, const Plane& truth, const Mask& foreground) {
  const bool same = !test.channels.empty() && test.channels.size() == truth.channels.size() &&
                    test.channels[0].layout() == truth.channels[0].layout();
  if (!same)
    throw Error("'{}' cannot be compared: the test is {} and the truth is {}", test.name, size_text(test),
                size_text(truth));
  const Layout& layout = test.channels[0].layout();
  if (foreground.size() != size_t(layout.width) * size_t(layout.height))
    throw Error("'{}' cannot be compared: the images have {}x{} pixels and the mask has {}", test.name, layout.width,
                layout.height, foreground.size());
  if (std::all_of(foreground.begin(), foreground.end(), [](unsigned char m) { return m == 0; }))
    throw Error("'{}' cannot be compared: all {}x{} pixels are background", test.name, layout.width, layout.height);
}

void check_finite(float value, const Plane& plane, const char* image, int x, int y) {
  if (std::isfinite(value)) return;
  throw Error("'{}' cannot be compared: the {} image is {} at pixel ({}, {}), which is not background", plane.name,
              image, value, x, y);
}

/// What the simple figures are made of. Doubles, added in pixel order on one thread: the same bits every time.
struct Sums {
  long long pixels = 0, over_1_255 = 0, over_0_05 = 0;
  double absolute = 0, squared = 0, difference = 0, max = 0;
};

void add_pixel(Sums& sums, const Plane& test, const Plane& truth, int x, int y) {
  double largest = 0;
  for (size_t c = 0; c < test.channels.size(); ++c) {
    const float a = test.channels[c].at(x, y), b = truth.channels[c].at(x, y);
    check_finite(a, test, "test", x, y);
    check_finite(b, truth, "truth", x, y);
    const double d = double(a) - double(b);
    sums.absolute += std::abs(d);
    sums.squared += d * d;
    sums.difference += d;
    largest = std::max(largest, std::abs(d));
  }
  ++sums.pixels;
  sums.max = std::max(sums.max, largest);
  sums.over_1_255 += largest > 1.0 / 255;
  sums.over_0_05 += largest > 0.05;
}

Sums add_all(const Plane& test, const Plane& truth, const Mask& foreground) {
  const Layout& layout = test.channels[0].layout();
  Sums sums;
  for (int y = 0; y < layout.height; ++y)
    for (int x = 0; x < layout.width; ++x)
      if (foreground[size_t(y) * size_t(layout.width) + size_t(x)]) add_pixel(sums, test, truth, x, y);
  return sums;
}

Metrics simple_figures(const Sums& sums, size_t components) {
  const double pixels = double(sums.pixels), values = pixels * double(components);
  const double mse = sums.squared / values;
  Metrics m;
  m.pixels = sums.pixels;
  m.mae = sums.absolute / values;
  m.rmse = std::sqrt(mse);
  m.bias = sums.difference / values;
  if (mse > 0) m.psnr = -10 * std::log10(mse);
  m.max = sums.max;
  m.over_1_255 = double(sums.over_1_255) / pixels;
  m.over_0_05 = double(sums.over_0_05) / pixels;
  return m;
}

/// Rows [first, last) as OpenCV's measures want them: 0..255. Background is open (1) in both images, so that whatever
/// stands there says nothing, not even through a window that reaches across the edge of a surface.
cv::Mat scaled_rows(const Channel& channel, const Mask& foreground, int first, int last) {
  const int width = channel.layout().width;
  cv::Mat rows(last - first, width, CV_64F);
  for (int y = first; y < last; ++y) {
    const unsigned char* counts = foreground.data() + size_t(y) * size_t(width);
    double* out = rows.ptr<double>(y - first);
    for (int x = 0; x < width; ++x) out[x] = counts[x] ? 255.0 * double(channel.at(x, y)) : 255.0;
  }
  return rows;
}

/// SSIM lies in -1..1; only rounding, with values of a million and more, leads out of it.
double bounded(double similarity) { return std::isfinite(similarity) ? std::clamp(similarity, -1.0, 1.0) : 0.0; }

/// Mean of the SSIM map over the foreground. The bands overlap by the reach of the window: the same values as from the
/// whole image at once.
double ssim(const Channel& test, const Channel& truth, const Mask& foreground) {
  const int width = test.layout().width, height = test.layout().height;
  double sum = 0;
  long long count = 0;
  for (int y0 = 0; y0 < height; y0 += band_rows) {
    const int y1 = std::min(y0 + band_rows, height);
    const int first = std::max(y0 - ssim_reach, 0), last = std::min(y1 + ssim_reach, height);
    cv::Mat map;
    cv::quality::QualitySSIM::compute(scaled_rows(truth, foreground, first, last),
                                      scaled_rows(test, foreground, first, last), map);
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width; ++x)
        if (foreground[size_t(y) * size_t(width) + size_t(x)]) {
          sum += bounded(map.at<double>(y - first, x));
          ++count;
        }
  }
  return sum / double(count);
}

/// Whether the block of 2 x 2 pixels that became pixel (x, y) of the GMSD map holds foreground.
bool block_counts(const Mask& foreground, const Layout& layout, int x, int y) {
  for (int v = 2 * y; v < std::min(2 * y + 2, layout.height); ++v)
    for (int u = 2 * x; u < std::min(2 * x + 2, layout.width); ++u)
      if (foreground[size_t(v) * size_t(layout.width) + size_t(u)]) return true;
  return false;
}

/// Similarity of gradients for rows [first, last): a map of half the size, as OpenCV halves the images first. Where
/// an image is one pixel wide or high nothing would be left, so that pixel is doubled.
cv::Mat gradient_similarity(const Channel& test, const Channel& truth, const Mask& foreground, int first, int last) {
  const Layout& layout = test.layout();
  const auto prepared = [&](const Channel& channel) {
    cv::Mat rows = scaled_rows(channel, foreground, first, last);
    if (layout.width == 1) cv::hconcat(rows, rows, rows);
    if (layout.height == 1) cv::vconcat(rows, rows, rows);
    return rows;
  };
  cv::Mat map;
  cv::quality::QualityGMSD::compute(prepared(truth), prepared(test), map);
  return map;
}

/// Standard deviation of the map over the blocks that hold foreground; 0 where the map sees none of it (OpenCV drops
/// the last column of an image 5 pixels wide: it rounds half the width to an even number). Bands start at multiples
/// of 4 rows, which keeps that rounding the same as for the whole image.
double gmsd(const Channel& test, const Channel& truth, const Mask& foreground) {
  const Layout& layout = test.layout();
  double sum = 0, squares = 0;  // of similarity - 1, which is small: no cancellation, and exactly 0 for equal images
  long long count = 0;
  for (int y0 = 0; y0 < layout.height; y0 += band_rows) {
    const int y1 = std::min(y0 + band_rows, layout.height);
    const int first = std::max(y0 - gmsd_reach, 0), last = std::min(y1 + gmsd_reach, layout.height);
    const cv::Mat map = gradient_similarity(test, truth, foreground, first, last);
    const int end = y1 == layout.height ? first / 2 + map.rows : y1 / 2;
    for (int y = y0 / 2; y < end; ++y)
      for (int x = 0; x < map.cols; ++x)
        if (block_counts(foreground, layout, x, y)) {
          const double below = map.at<double>(y - first / 2, x) - 1;
          sum += below;
          squares += below * below;
          ++count;
        }
  }
  if (count == 0) return 0;
  const double mean = sum / double(count);
  return std::sqrt(std::max(squares / double(count) - mean * mean, 0.0));
}

constexpr size_t colours = 3;

/// Whether red, green and blue come first.
bool is_colour(const Plane& plane) {
  const std::vector<std::string> names = plane_kind(plane.name).components, rgb = plane_kind("color").components;
  return plane.channels.size() >= colours && names.size() >= plane.channels.size() &&
         std::equal(rgb.begin(), rgb.end(), names.begin());
}

/// Rows [first, last) of three channels. Background is white in both images.
cv::Mat colour_rows(const Plane& plane, const Mask& foreground, int first, int last) {
  const int width = plane.channels[0].layout().width;
  cv::Mat rows(last - first, width, CV_64FC3);
  for (int y = first; y < last; ++y) {
    const unsigned char* counts = foreground.data() + size_t(y) * size_t(width);
    cv::Vec3d* out = rows.ptr<cv::Vec3d>(y - first);
    for (int x = 0; x < width; ++x) {
      for (size_t c = 0; c < colours; ++c) out[x][int(c)] = counts[x] ? double(plane.channels[c].at(x, y)) : 1.0;
    }
  }
  return rows;
}

/// Mean of the FLIP map over the foreground, in bands that overlap as those of `ssim` do.
double flip(const Plane& test, const Plane& truth, const Mask& foreground) {
  const int width = test.channels[0].layout().width, height = test.channels[0].layout().height;
  double sum = 0;
  long long count = 0;
  for (int y0 = 0; y0 < height; y0 += band_rows) {
    const int y1 = std::min(y0 + band_rows, height);
    const int first = std::max(y0 - flip_reach(), 0), last = std::min(y1 + flip_reach(), height);
    const cv::Mat map =
        flip_map(colour_rows(test, foreground, first, last), colour_rows(truth, foreground, first, last));
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!foreground[size_t(y) * size_t(width) + size_t(x)]) continue;
        sum += map.at<double>(y - first, x);
        ++count;
      }
    }
  }
  return sum / double(count);
}

template <typename Function>
Plane with_each(const Plane& plane, const Function& function) {
  Plane out = plane.clone();
  for (Channel& channel : out.channels) {
    for (int y = 0; y < channel.layout().height; ++y)
      for (int x = 0; x < channel.layout().width; ++x) channel.at(x, y) = function(channel.at(x, y));
  }
  return out;
}

/// What a screen can show of radiance, in linear light. What is not finite is background, and stays.
Plane exposed(const Plane& plane, double exposure) {
  return with_each(
      plane, [exposure](float v) { return std::isfinite(v) ? float(std::clamp(exposure * double(v), 0.0, 1.0)) : v; });
}

/// Through sRGB.
Plane encoded(const Plane& linear) {
  return with_each(linear, [](float v) { return std::isfinite(v) ? float(srgb(v)) : v; });
}

/// Where the truth is dark the difference counts by itself.
double relative_squared_error(const Plane& test, const Plane& truth, const Mask& foreground) {
  const int width = test.channels[0].layout().width, height = test.channels[0].layout().height;
  double sum = 0;
  long long count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!foreground[size_t(y) * size_t(width) + size_t(x)]) continue;
      for (size_t c = 0; c < colours; ++c) {
        const double expected = truth.channels[c].at(x, y), d = double(test.channels[c].at(x, y)) - expected;
        sum += d * d / (expected * expected + 0.01);
        ++count;
      }
    }
  }
  return sum / double(count);
}

}  // namespace

Metrics compare(const Plane& test, const Plane& truth, const Mask& foreground, double exposure) {
  check_sizes(test, truth, foreground);
  const size_t components = test.channels.size();
  Metrics metrics = simple_figures(add_all(test, truth, foreground), components);
  // OpenCV would start OpenCL by itself and compute there, with other rounding on every device.
  cv::ocl::setUseOpenCL(false);
  const auto add = [&](const Plane& a, const Plane& b, const Plane& encoded_a, const Plane& encoded_b) {
    for (size_t c = 0; c < components; ++c) {
      metrics.ssim += ssim(encoded_a.channels[c], encoded_b.channels[c], foreground) / double(components);
      metrics.gmsd += gmsd(encoded_a.channels[c], encoded_b.channels[c], foreground) / double(components);
    }
    if (is_colour(test)) metrics.flip = flip(a, b, foreground);
  };
  if (exposure > 0) {
    const Plane a = exposed(test, exposure), b = exposed(truth, exposure);
    add(a, b, encoded(a), encoded(b));
  } else {
    add(test, truth, test, truth);
  }
  if (is_colour(test)) {
    metrics.rse = relative_squared_error(test, truth, foreground);
  }
  return metrics;
}

}  // namespace gloam
