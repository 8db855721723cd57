#include "bench/pictures.h"

#include <algorithm>
#include <cctype>
#include <opencv2/core.hpp>

#include "gloam/planes.h"
#include "picture/picture.h"

namespace gloam::bench {
namespace {

double mean_at(const Plane& plane, int x, int y) {
  double sum = 0;
  for (const Channel& channel : plane.channels) sum += channel.at(x, y);
  return sum / double(plane.channels.size());
}

}  // namespace

std::string file_name(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte < 128 && (std::isalnum(byte) || c == '.' || c == '_' || c == '-'))
      safe += c;
    else if (c == '+')
      safe += "plus";
    else if (safe.empty() || safe.back() != '-')
      safe += '-';
  }
  // Neither hidden nor a folder above.
  return safe.empty() || safe.front() == '.' ? "_" + safe : safe;
}

void write_grey(const std::filesystem::path& path, const Plane& plane, const Channel& depth, double white) {
  const Layout& layout = depth.layout();
  cv::Mat image(layout.height, layout.width, CV_8UC2);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const bool background = is_background(depth.at(x, y));
      const unsigned char grey = background ? 0 : to_byte(mean_at(plane, x, y) / white);
      image.at<cv::Vec2b>(y, x) = background ? cv::Vec2b(0, 0) : cv::Vec2b(grey, 255);
    }
  }
  write_png(path, image);
}

double white_of(const Plane& plane, const Channel& depth) {
  if (plane_kind(plane.name).meaning == PlaneKind::unit_interval) return 1;
  std::vector<double> values;
  const Layout& layout = depth.layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (!is_background(depth.at(x, y))) values.push_back(mean_at(plane, x, y));
    }
  }
  if (values.empty()) return 1;
  const auto brightest = values.begin() + std::ptrdiff_t(values.size() * 99 / 100);
  std::nth_element(values.begin(), brightest, values.end());
  return *brightest > 0 ? *brightest : 1;
}

}  // namespace gloam::bench
