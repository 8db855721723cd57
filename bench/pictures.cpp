#include "bench/pictures.h"

#include <cctype>
#include <opencv2/core.hpp>

#include "picture/picture.h"

namespace gloam::bench {

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

void write_share(const std::filesystem::path& path, const Channel& values, const Channel& depth) {
  const Layout& layout = values.layout();
  cv::Mat image(layout.height, layout.width, CV_8UC2);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const bool background = is_background(depth.at(x, y));
      image.at<cv::Vec2b>(y, x) = background ? cv::Vec2b(0, 0) : cv::Vec2b(to_byte(values.at(x, y)), 255);
    }
  }
  write_png(path, image);
}

}  // namespace gloam::bench
