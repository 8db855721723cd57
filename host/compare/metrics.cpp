#include "gloam/metrics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/ocl.hpp>
#include <opencv2/quality/qualitygmsd.hpp>
#include <opencv2/quality/qualityssim.hpp>

#include "base/srgb.h"
#include "compare/flip.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// Rows per band of the similarity maps. OpenCV holds some sixteen images of doubles per map: 8 GiB for a whole 8192 x 8192
/// frame. A multiple of 4, see `add_gmsd`.
int band_rows(int width) {
  constexpr int pixels = 1 << 20, least = 32;
  return std::clamp(pixels / width / 4 * 4, least, Comparison::step);
}

/// SSIM's window is 11 x 11.
constexpr int ssim_reach = 5;

/// A row of the GMSD map needs its neighbours above and below; each is made from two rows of the image.
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
}

void check_finite(float value, const Plane& plane, const char* image, int x, int y) {
  if (std::isfinite(value)) return;
  throw Error("'{}' cannot be compared: the {} image is {} at pixel ({}, {}), which is not background", plane.name,
              image, value, x, y);
}

int width_of(const ComparedRows& rows) { return rows.test.channels[0].layout().width; }

/// Whether a pixel of the image counts.
bool counts(const ComparedRows& rows, int x, int y) {
  return rows.foreground[size_t(y - rows.top) * size_t(width_of(rows)) + size_t(x)] != 0;
}

/// `Sums`: of Comparison.
template <typename Sums>
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

/// Rows [first, last) of the image as OpenCV's measures expect them: 0..255. Background is open (1) in both images, so that its
/// values do not count, not even through a window that reaches across the edge of a surface.
cv::Mat scaled_rows(const Channel& channel, const ComparedRows& of, int first, int last) {
  const int width = width_of(of);
  cv::Mat rows(last - first, width, CV_64F);
  for (int y = first; y < last; ++y) {
    double* out = rows.ptr<double>(y - first);
    for (int x = 0; x < width; ++x) out[x] = counts(of, x, y) ? 255.0 * double(channel.at(x, y - of.top)) : 255.0;
  }
  return rows;
}

/// SSIM lies in -1..1; only rounding, with values of a million and more, exceeds it.
double bounded(double similarity) { return std::isfinite(similarity) ? std::clamp(similarity, -1.0, 1.0) : 0.0; }

/// Whether the block of 2 x 2 pixels that became pixel (x, y) of the GMSD map holds foreground.
bool block_counts(const ComparedRows& rows, int height, int x, int y) {
  for (int v = 2 * y; v < std::min(2 * y + 2, height); ++v)
    for (int u = 2 * x; u < std::min(2 * x + 2, width_of(rows)); ++u)
      if (counts(rows, u, v)) return true;
  return false;
}

/// Similarity of gradients for rows [first, last) of the image: a map of half the size, since OpenCV halves the images first. An
/// image that is one pixel wide or high would vanish, so that pixel is doubled.
cv::Mat gradient_similarity(const ComparedRows& of, size_t channel, int height, int first, int last) {
  const auto prepared = [&](const Plane& plane) {
    cv::Mat rows = scaled_rows(plane.channels[channel], of, first, last);
    if (width_of(of) == 1) cv::hconcat(rows, rows, rows);
    if (height == 1) cv::vconcat(rows, rows, rows);
    return rows;
  };
  cv::Mat map;
  cv::quality::QualityGMSD::compute(prepared(of.truth), prepared(of.test), map);
  return map;
}

constexpr size_t colours = 3;

/// Whether the first components are red, green and blue.
bool is_colour(const Plane& plane) {
  const std::vector<std::string> names = plane_kind(plane.name).components, rgb = plane_kind("color").components;
  return plane.channels.size() >= colours && names.size() >= plane.channels.size() &&
         std::equal(rgb.begin(), rgb.end(), names.begin());
}

/// Rows [first, last) of the image, three channels. Background is white in both images.
cv::Mat colour_rows(const Plane& plane, const ComparedRows& of, int first, int last) {
  const int width = width_of(of);
  cv::Mat rows(last - first, width, CV_64FC3);
  for (int y = first; y < last; ++y) {
    cv::Vec3d* out = rows.ptr<cv::Vec3d>(y - first);
    for (int x = 0; x < width; ++x) {
      for (size_t c = 0; c < colours; ++c)
        out[x][int(c)] = counts(of, x, y) ? double(plane.channels[c].at(x, y - of.top)) : 1.0;
    }
  }
  return rows;
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

/// Radiance as a screen shows it, in linear light. Values that are not finite are background, and stay.
Plane exposed(const Plane& plane, double exposure) {
  return with_each(
      plane, [exposure](float v) { return std::isfinite(v) ? float(std::clamp(exposure * double(v), 0.0, 1.0)) : v; });
}

/// Encodes linear light as sRGB.
Plane encoded(const Plane& linear) {
  return with_each(linear, [](float v) { return std::isfinite(v) ? float(srgb(v)) : v; });
}

}  // namespace

double Comparison::Deviation::value() const {
  if (count == 0) return 0;
  const double mean = sum / double(count);
  return std::sqrt(std::max(squares / double(count) - mean * mean, 0.0));
}

int Comparison::reach() { return std::max({ssim_reach, gmsd_reach, flip_reach()}); }

unsigned long long Comparison::bytes(int width, size_t components) {
  constexpr unsigned long long maps = 20, of_colour = 3;
  const unsigned long long rows = static_cast<unsigned long long>(band_rows(width) + 2 * reach());
  return maps * sizeof(double) * rows * static_cast<unsigned long long>(width) *
         (components >= colours ? of_colour : 1);
}

void Comparison::add_pixel(const ComparedRows& rows, int x, int y) {
  double largest = 0;
  for (size_t c = 0; c < rows.test.channels.size(); ++c) {
    const float a = rows.test.channels[c].at(x, y - rows.top), b = rows.truth.channels[c].at(x, y - rows.top);
    check_finite(a, rows.test, "test", x, y);
    check_finite(b, rows.truth, "truth", x, y);
    const double d = double(a) - double(b);
    sums_.absolute += std::abs(d);
    sums_.squared += d * d;
    sums_.difference += d;
    largest = std::max(largest, std::abs(d));
  }
  ++sums_.pixels;
  sums_.max = std::max(sums_.max, largest);
  sums_.over_1_255 += largest > 1.0 / 255;
  sums_.over_0_05 += largest > 0.05;
}

void Comparison::add_simple(const ComparedRows& rows, int first, int last) {
  for (int y = first; y < last; ++y)
    for (int x = 0; x < width_of(rows); ++x)
      if (counts(rows, x, y)) add_pixel(rows, x, y);
}

/// Adds SSIM over the foreground. Bands overlap by the reach of the window, so the values are those of the whole image.
void Comparison::add_ssim(const ComparedRows& rows, size_t channel, int y0, int y1) {
  const int first = std::max(y0 - ssim_reach, 0), last = std::min(y1 + ssim_reach, height_);
  cv::Mat map;
  cv::quality::QualitySSIM::compute(scaled_rows(rows.truth.channels[channel], rows, first, last),
                                    scaled_rows(rows.test.channels[channel], rows, first, last), map);
  for (int y = y0; y < y1; ++y)
    for (int x = 0; x < width_of(rows); ++x)
      if (counts(rows, x, y)) {
        ssim_[channel].sum += bounded(map.at<double>(y - first, x));
        ++ssim_[channel].count;
      }
}

/// Adds GMSD over the blocks that hold foreground; none if the map misses all of them (OpenCV drops the last column of an image 5
/// pixels wide: it rounds half the width to an even number). Bands start at multiples of 4 rows, so that this rounding is the
/// same as for the whole image.
void Comparison::add_gmsd(const ComparedRows& rows, size_t channel, int y0, int y1) {
  const int first = std::max(y0 - gmsd_reach, 0), last = std::min(y1 + gmsd_reach, height_);
  const cv::Mat map = gradient_similarity(rows, channel, height_, first, last);
  const int end = y1 == height_ ? first / 2 + map.rows : y1 / 2;
  Deviation& deviation = gmsd_[channel];
  for (int y = y0 / 2; y < end; ++y)
    for (int x = 0; x < map.cols; ++x)
      if (block_counts(rows, height_, x, y)) {
        const double below = map.at<double>(y - first / 2, x) - 1;
        deviation.sum += below;
        deviation.squares += below * below;
        ++deviation.count;
      }
}

/// Adds FLIP over the foreground, in bands that overlap as those of SSIM.
void Comparison::add_flip(const ComparedRows& rows, int y0, int y1) {
  const int first = std::max(y0 - flip_reach(), 0), last = std::min(y1 + flip_reach(), height_);
  const cv::Mat map = flip_map(colour_rows(rows.test, rows, first, last), colour_rows(rows.truth, rows, first, last));
  for (int y = y0; y < y1; ++y) {
    for (int x = 0; x < width_of(rows); ++x) {
      if (!counts(rows, x, y)) continue;
      flip_->sum += map.at<double>(y - first, x);
      ++flip_->count;
    }
  }
}

/// Adds the relative error. Where the truth is dark, the plain difference counts.
void Comparison::add_relative(const ComparedRows& rows, int first, int last) {
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < width_of(rows); ++x) {
      if (!counts(rows, x, y)) continue;
      for (size_t c = 0; c < colours; ++c) {
        const double expected = rows.truth.channels[c].at(x, y - rows.top),
                     d = double(rows.test.channels[c].at(x, y - rows.top)) - expected;
        relative_->sum += d * d / (expected * expected + 0.01);
        ++relative_->count;
      }
    }
  }
}

void Comparison::add(const ComparedRows& rows, int first, int last) {
  check_sizes(rows.test, rows.truth, rows.foreground);
  const size_t components = rows.test.channels.size();
  if (ssim_.empty()) {
    name_ = rows.test.name;
    size_ = fmt::format("{}x{}", width_of(rows), height_);
    ssim_.resize(components);
    gmsd_.resize(components);
    if (is_colour(rows.test)) flip_.emplace(), relative_.emplace();
  }
  add_simple(rows, first, last);
  if (relative_) add_relative(rows, first, last);
  // OpenCV would use OpenCL by itself, with other rounding on every device.
  cv::ocl::setUseOpenCL(false);
  const auto add_maps = [&](const ComparedRows& linear, const ComparedRows& seen) {
    const int band = band_rows(width_of(rows));
    for (int y0 = first; y0 < last; y0 += band) {
      const int y1 = std::min(y0 + band, last);
      for (size_t c = 0; c < components; ++c) add_ssim(seen, c, y0, y1), add_gmsd(seen, c, y0, y1);
      if (flip_) add_flip(linear, y0, y1);
    }
  };
  if (exposure_ > 0) {
    const Plane a = exposed(rows.test, exposure_), b = exposed(rows.truth, exposure_);
    const Plane seen_a = encoded(a), seen_b = encoded(b);
    add_maps({a, b, rows.foreground, rows.top}, {seen_a, seen_b, rows.foreground, rows.top});
  } else {
    add_maps(rows, rows);
  }
}

Metrics Comparison::figures() const {
  if (pixels() == 0) throw Error("'{}' cannot be compared: all {} pixels are background", name_, size_);
  const size_t components = ssim_.size();
  Metrics metrics = simple_figures(sums_, components);
  for (size_t c = 0; c < components; ++c) {
    metrics.ssim += ssim_[c].value() / double(components);
    metrics.gmsd += gmsd_[c].value() / double(components);
  }
  if (flip_) metrics.flip = flip_->value();
  if (relative_) metrics.rse = relative_->value();
  return metrics;
}

Metrics compare(const Plane& test, const Plane& truth, const Mask& foreground, double exposure) {
  check_sizes(test, truth, foreground);
  if (std::all_of(foreground.begin(), foreground.end(), [](unsigned char m) { return m == 0; }))
    throw Error("'{}' cannot be compared: all {}x{} pixels are background", test.name, test.channels[0].layout().width,
                test.channels[0].layout().height);
  const int height = test.channels[0].layout().height;
  Comparison comparison(height, exposure);
  comparison.add({test, truth, foreground}, 0, height);
  return comparison.figures();
}

}  // namespace gloam
