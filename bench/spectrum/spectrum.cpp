#include "spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "gloam/error.h"

namespace gloam::bench {
namespace {

constexpr int side = 32;        // of a window, pixels
constexpr int step = side / 2;  // from window to window
constexpr double flatness = 1e-3, evenness = 0.03;

cv::Mat window_of(const Channel& channel, int left, int top) {
  cv::Mat window(side, side, CV_64F);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) window.at<double>(y, x) = double(channel.at(left + x, top + y));
  }
  return window;
}

/// Whether a + b x + c y fits to the values, up to a share of their mean.
bool is_plane(const cv::Mat& values) {
  const double mean = cv::mean(values)[0], centre = (side - 1) / 2.0;
  double across = 0, down = 0;
  const double square = side * side * (side * side - 1) / 12.0;  // sum of (x - centre)^2
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      across += values.at<double>(y, x) * (x - centre) / square;
      down += values.at<double>(y, x) * (y - centre) / square;
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double off = values.at<double>(y, x) - mean - across * (x - centre) - down * (y - centre);
      if (!(std::abs(off) <= flatness * std::abs(mean))) return false;
    }
  }
  return true;
}

bool shows_one_plane(const cv::Mat& depth) { return is_plane(depth) || is_plane(1 / depth); }

bool is_even(const cv::Mat& truth) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(truth, mean, deviation);
  return deviation[0] <= evenness;
}

/// Power by frequency of a window, tapered to its edges; the sum is the variance.
cv::Mat power_of(cv::Mat error) {
  error -= cv::mean(error);
  cv::Mat hann(side, 1, CV_64F);
  for (int i = 0; i < side; ++i) hann.at<double>(i) = 0.5 - 0.5 * std::cos(2 * CV_PI * (i + 0.5) / side);
  const cv::Mat taper = hann * hann.t();
  cv::Mat spectrum;
  cv::dft(error.mul(taper), spectrum, cv::DFT_COMPLEX_OUTPUT);
  std::vector<cv::Mat> parts;
  cv::split(spectrum, parts);
  const double scale = 1 / (cv::sum(taper.mul(taper))[0] * side * side);
  return (parts[0].mul(parts[0]) + parts[1].mul(parts[1])) * scale;
}

/// Pixels; infinite for the mean.
double wavelength_at(int column, int row) {
  const int x = std::min(column, side - column), y = std::min(row, side - row);
  return side / std::hypot(double(x), double(y));
}

double peak_over_median(const cv::Mat& power) {
  std::vector<double> short_waves;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (wavelength_at(column, row) <= 8) short_waves.push_back(power.at<double>(row, column));
    }
  }
  std::sort(short_waves.begin(), short_waves.end());
  const double median = short_waves[short_waves.size() / 2];
  return median > 0 ? short_waves.back() / median : 0;
}

}  // namespace

Spectrum spectrum_over_flat(const Channel& test, const Channel& truth, const Channel& depth) {
  const Layout& layout = truth.layout();
  for (const Channel* other : {&test, &depth}) {
    if (other->layout().width != layout.width || other->layout().height != layout.height)
      throw Error("images of {}x{} and {}x{} pixels cannot be compared", other->layout().width, other->layout().height,
                  layout.width, layout.height);
  }
  Spectrum spectrum;
  cv::Mat power = cv::Mat::zeros(side, side, CV_64F);
  for (int top = 0; top + side <= layout.height; top += step) {
    for (int left = 0; left + side <= layout.width; left += step) {
      const cv::Mat depths = window_of(depth, left, top), even = window_of(truth, left, top);
      if (!cv::checkRange(depths) || !shows_one_plane(depths) || !is_even(even)) continue;
      power += power_of(window_of(test, left, top) - even);
      ++spectrum.windows;
    }
  }
  if (spectrum.windows == 0) throw Error("no {0}x{0} pixels show a flat surface that is evenly lit", side);
  power /= spectrum.windows;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double length = wavelength_at(column, row);
      for (int band = 0; band < spectrum_bands; ++band) {
        if ((length >= 2 << band || band == 0) && length < 4 << band)
          spectrum.rms[size_t(band)] += power.at<double>(row, column);
      }
    }
  }
  for (double& rms : spectrum.rms) rms = std::sqrt(rms);
  spectrum.peak = peak_over_median(power);
  return spectrum;
}

}  // namespace gloam::bench
