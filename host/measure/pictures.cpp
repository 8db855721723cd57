#include "measure/pictures.h"

#include <algorithm>
#include <cctype>
#include <opencv2/core.hpp>

#include "base/hash.h"
#include "gloam/error.h"
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
  bool is_unlike = name.find("plus") != std::string::npos;  // as "+" is written
  for (const char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte < 128 && (std::isalnum(byte) || c == '.' || c == '_' || c == '-'))
      safe += c;
    else if (c == '+')
      safe += "plus";
    else {
      is_unlike |= c != ' ' || safe.empty() || safe.back() == '-';
      if (safe.empty() || safe.back() != '-') safe += '-';
    }
  }
  // Neither hidden nor a folder above.
  if (safe.empty() || safe.front() == '.') safe = "_" + safe, is_unlike = true;
  // Names of which the same is left are told apart, but for one space in place of '-'.
  return is_unlike ? fmt::format("{}-{:08x}", safe, uint32_t(hash_of(name))) : safe;
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

std::string picture_folder(const std::string& scene, const std::string& effect) {
  return "images/" + file_name(scene + (effect == "ao" ? "" : "_" + effect));
}

const View& pictured_view(const Frame& frame, const std::vector<const Image*>& images) {
  const auto is_in_all = [&](const View& view) {
    return std::all_of(images.begin(), images.end(),
                       [&](const Image* image) { return !image || image->count(view.name); });
  };
  const auto found = std::find_if(frame.views.begin(), frame.views.end(), is_in_all);
  return found == frame.views.end() ? frame.views.front() : *found;
}

void make_folder_of(const std::filesystem::path& folder, const std::string& path) {
  const std::filesystem::path made = (folder / path).parent_path();
  std::error_code error;
  std::filesystem::create_directories(made, error);
  if (error) throw Error("{}: cannot be made ({})", made.string(), error.message());
}

}  // namespace gloam::bench
