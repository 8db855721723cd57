#include "picture/differences.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam {
namespace {

/// One side of the difference map, from no difference to the end of the scale: equal steps of lightness in the OKLab space (0.975
/// to 0.4) at one hue per side, so that equal differences look equally different and both signs have the same weight.
constexpr std::array<std::array<int, 3>, 6> too_dark_colours{
    // red, green, blue
    {{247, 247, 247}, {191, 211, 239}, {134, 175, 232}, {81, 138, 217}, {40, 102, 185}, {17, 70, 137}}};
constexpr std::array<std::array<int, 3>, 6> too_bright_colours{
    {{247, 247, 247}, {237, 199, 192}, {226, 150, 137}, {206, 102, 86}, {171, 63, 49}, {125, 36, 26}}};

/// Possible ends of the scale: round numbers, so that two pictures are likely to share one and can be compared.
constexpr std::array<float, 5> ranges{0.05f, 0.1f, 0.2f, 0.5f, 1.0f};

}  // namespace

Differences differences(const Plane& test, const Plane& truth, const Mask& foreground) {
  const bool same = !test.channels.empty() && test.channels.size() == truth.channels.size() &&
                    test.channels[0].layout() == truth.channels[0].layout();
  if (!same)
    throw Error(
        "'{}': test and truth have different sizes or components; a difference is drawn where both are the same",
        test.name);
  const Layout& layout = test.channels[0].layout();
  if (layout.width < 1 || layout.height < 1 || foreground.size() != size_t(layout.width) * size_t(layout.height))
    throw Error("'{}': the mask does not have the {}x{} pixels of the images", test.name, layout.width, layout.height);
  return {test, truth, foreground, layout.width, layout.height, test.channels.size()};
}

// A few outliers must not wash out the rest.
float fitting_range(const Differences& d) {
  std::array<long long, ranges.size()> within{};
  long long pixels = 0;
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) {
      if (!d.counts(x, y)) continue;
      ++pixels;
      const double size = std::abs(d.at(x, y));
      for (size_t i = 0; i < ranges.size(); ++i) within[i] += size <= double(ranges[i]);
    }
  for (size_t i = 0; i < ranges.size(); ++i)
    if (double(within[i]) >= 0.99 * double(pixels)) return ranges[i];
  return ranges.back();
}

cv::Vec3b difference_colour(double t) {
  const auto& colours = t < 0 ? too_dark_colours : too_bright_colours;
  const double position = std::min(std::abs(t), 1.0) * double(colours.size() - 1);
  const size_t i = std::min(size_t(position), colours.size() - 2);
  const double f = position - double(i);
  cv::Vec3b colour;
  for (int c = 0; c < 3; ++c)
    colour[c] =
        cv::saturate_cast<unsigned char>(colours[i][size_t(2 - c)] * (1 - f) + colours[i + 1][size_t(2 - c)] * f);
  return colour;
}

cv::Mat difference_image(const Differences& d, double range) {
  cv::Mat image(d.height, d.width, CV_8UC3);
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x)
      image.at<cv::Vec3b>(y, x) = difference_colour(d.counts(x, y) ? d.at(x, y) / range : 0);
  return image;
}

Histogram histogram_of(const Differences& d, double range, int bins) {
  Histogram h{std::vector<long long>(size_t(bins), 0)};
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) {
      if (!d.counts(x, y)) continue;
      for (size_t c = 0; c < d.components; ++c) {
        const double t = d.of_component(c, x, y) / range;
        const int bin = std::clamp(int(std::floor((std::clamp(t, -2.0, 2.0) + 1) / 2 * bins)), 0, bins - 1);
        ++h.bins[size_t(bin)];
        h.beyond += std::abs(t) > 1;
        ++h.all;
      }
    }
  h.largest = *std::max_element(h.bins.begin(), h.bins.end());
  return h;
}

}  // namespace gloam
