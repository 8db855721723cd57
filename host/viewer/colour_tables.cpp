#include "viewer/colour_tables.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

namespace gloam::viewer {
namespace {

std::string table_of(cv::ColormapTypes map) {
  cv::Mat grey(1, 256, CV_8UC1), colours;
  for (int i = 0; i < 256; ++i) grey.at<unsigned char>(0, i) = static_cast<unsigned char>(i);
  cv::applyColorMap(grey, colours, map);
  std::string text;
  for (int i = 0; i < 256; ++i) {
    const cv::Vec3b colour = colours.at<cv::Vec3b>(0, i);
    text += fmt::format("{:02x}{:02x}{:02x}", colour[2], colour[1], colour[0]);
  }
  return text;
}

}  // namespace

nlohmann::ordered_json colour_tables() {
  return {{"viridis", table_of(cv::COLORMAP_VIRIDIS)},
          {"inferno", table_of(cv::COLORMAP_INFERNO)},
          {"cividis", table_of(cv::COLORMAP_CIVIDIS)},
          {"turbo", table_of(cv::COLORMAP_TURBO)}};
}

}  // namespace gloam::viewer
