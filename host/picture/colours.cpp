#include "picture/colours.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "picture/picture.h"

namespace gloam {
namespace {

/// Colour of foreground values that are NaN, infinite, or not positive where they must be: on no scale.
const cv::Vec3b not_finite_colour(255, 0, 255);

using ColourTable = std::array<cv::Vec3b, 256>;

ColourTable colour_table(cv::ColormapTypes map) {
  cv::Mat grey(1, 256, CV_8UC1), colours;
  for (int i = 0; i < 256; ++i) grey.at<unsigned char>(0, i) = static_cast<unsigned char>(i);
  cv::applyColorMap(grey, colours, map);
  ColourTable table;
  for (int i = 0; i < 256; ++i) table[size_t(i)] = colours.at<cv::Vec3b>(0, i);
  return table;
}

/// Depth and count colours run evenly from dark to bright, also for colour-blind readers.
const ColourTable& depth_colours() {
  static const ColourTable table = colour_table(cv::COLORMAP_VIRIDIS);
  return table;
}
const ColourTable& count_colours() {
  static const ColourTable table = colour_table(cv::COLORMAP_INFERNO);
  return table;
}

cv::Vec3b grey(double t) { return cv::Vec3b::all(to_byte(t)); }
cv::Vec3b red_green_blue(double r, double g, double b) { return {to_byte(b), to_byte(g), to_byte(r)}; }

/// `hue` in turns, red at 0; the others 0 to 1.
cv::Vec3b hue_colour(double hue, double saturation, double brightness) {
  const auto component = [&](double offset) {
    const double ramp = std::abs(6 * (hue + offset - std::floor(hue + offset)) - 3) - 1;
    return brightness * (1 - saturation * (1 - std::clamp(ramp, 0.0, 1.0)));
  };
  return red_green_blue(component(0), component(2.0 / 3), component(1.0 / 3));
}

/// A colour for an identity. Neighbouring numbers get unlike colours: their bits are mixed first (the finaliser of MurmurHash3).
cv::Vec3b identity_colour(float id) {
  uint32_t h = std::bit_cast<uint32_t>(id);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  return hue_colour((h & 0xffff) / 65536.0, 0.35 + 0.35 * ((h >> 16) & 0xff) / 255, 0.6 + 0.35 * (h >> 24) / 255);
}

cv::Vec3b motion_colour(double x, double y, const Range& length) {
  const double turns = std::atan2(y, x) / (2 * CV_PI), longest = length.last > 0 ? length.last : 1;
  return hue_colour(turns, 0.85, std::min(std::hypot(x, y) / longest, 1.0));
}

cv::Vec3b position_colour(const Plane& plane, const std::vector<Range>& ranges, int x, int y) {
  std::array<double, 3> t;
  for (size_t c = 0; c < 3; ++c) t[c] = ranges[c].position(plane.channels[c].at(x, y));
  return red_green_blue(t[0], t[1], t[2]);
}

/// Colour of a pixel, for styles that `image_of` does not cover.
cv::Vec3b colour_at(const Tile& tile, const std::vector<Range>& ranges, int x, int y) {
  const Plane& plane = *tile.plane;
  const double t = ranges[0].position(value_at(tile, 0, x, y));
  switch (tile.style) {
    case PictureStyle::depth:
      return depth_colour(t);
    case PictureStyle::count:
      return count_colours()[to_byte(0.1 + 0.9 * t)];
    case PictureStyle::identity:
      return identity_colour(plane.channels[0].at(x, y));
    case PictureStyle::position:
      return position_colour(plane, ranges, x, y);
    case PictureStyle::motion:
      return motion_colour(plane.channels[0].at(x, y), plane.channels[1].at(x, y), ranges[0]);
    default:
      return grey(t);
  }
}

bool comes_from_image_of(PictureStyle style) {
  return style == PictureStyle::direction || style == PictureStyle::colour || style == PictureStyle::share;
}

}  // namespace

cv::Vec3b depth_colour(double position) { return depth_colours()[to_byte(1 - position)]; }

cv::Mat colours_of(const Tile& tile, const std::vector<Range>& scale) {
  cv::Mat image(tile.layout().height, tile.layout().width, CV_8UC3);
  const bool ready = comes_from_image_of(tile.style);
  if (ready) image = coloured(*tile.plane);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      if (tile.is_background(x, y)) continue;  // drawn as background
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      if (!is_finite(tile, x, y))
        pixel = not_finite_colour;
      else if (!ready)
        pixel = colour_at(tile, scale, x, y);
    }
  return image;
}

}  // namespace gloam
