#include "picture/explanation_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "picture/picture.h"

namespace gloam {
namespace {

/// The blue of Okabe and Ito (2008), which every kind of colour blindness tells from grey. Blue, green, red.
const cv::Scalar tint(178, 114, 0);
/// Shares of the tint in the colour of a pixel, for the least change and for the largest.
constexpr double least_tint = 0.2, most_tint = 0.65;

double share_of_tint(double strength) { return least_tint + (most_tint - least_tint) * strength; }

/// Grey by the angle between normal and line of sight, or by nearness if there are no normals.
cv::Mat lit_from_the_eye(const View& view) {
  const Channel& depth = view.find("depth")->channels.front();
  const Plane* normal = view.find("normal");
  cv::Mat image(depth.layout().height, depth.layout().width, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double facing = normal ? std::max(0.0f, normal->channels[2].at(x, y)) : 1 / (1 + 0.1 * depth.at(x, y));
      image.at<cv::Vec3b>(y, x) = cv::Vec3b::all(to_byte(0.25 + 0.7 * facing));
    }
  }
  return image;
}

cv::Mat background_of(const Channel& depth) {
  cv::Mat mask(depth.layout().height, depth.layout().width, CV_8UC1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) mask.at<unsigned char>(y, x) = is_background(depth.at(x, y)) ? 255 : 0;
  return mask;
}

/// Light enough for the tint to stand out, with enough contrast to recognise the scene.
cv::Mat pale_grey(const cv::Mat& colours) {
  cv::Mat grey;
  cv::cvtColor(colours, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, -1, 0.43, 140);
  return grey;
}

/// A plane of one value per pixel or per square tile, by pixels of the image.
class Cells {
 public:
  Cells(const Plane& plane, cv::Size image) : values_(plane.channels.front()), side_(side_of(image)) {}

  float at(int x, int y) const {
    return values_.at(std::min(x / side_, values_.layout().width - 1),
                      std::min(y / side_, values_.layout().height - 1));
  }

 private:
  /// The last tile of a row may be cut, so the quotient of the sizes does not tell the side.
  int side_of(cv::Size image) const {
    const int most = std::max(image.width, image.height);
    for (int side = 1; side < 2 * most; side *= 2)
      if (reduced(Layout(image.width, image.height), side) == values_.layout()) return side;
    return std::max((image.width + values_.layout().width - 1) / values_.layout().width,
                    (image.height + values_.layout().height - 1) / values_.layout().height);
  }

  const Channel& values_;
  int side_;
};

std::optional<Cells> cells_of(const Plane* plane, cv::Size image) {
  return plane ? std::optional<Cells>(std::in_place, *plane, image) : std::nullopt;
}

void blend(cv::Vec3b& pixel, double share) {
  for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<unsigned char>(pixel[c] + share * (tint[c] - pixel[c]));
}

}  // namespace

PanelGround ground_of(const View& view) {
  PanelGround ground;
  const Plane* colour = view.find("color");
  ground.is_lit = !colour;
  ground.colours = colour ? coloured(*colour) : lit_from_the_eye(view);
  ground.pale = pale_grey(ground.colours);
  ground.no_surface = background_of(view.find("depth")->channels.front());
  return ground;
}

cv::Scalar tint_on_paper(double strength) {
  cv::Vec3b pixel = cv::Vec3b::all(255);
  blend(pixel, share_of_tint(strength));
  return cv::Scalar(pixel);
}

double largest_change(const std::vector<Explanation>& effects) {
  std::vector<float> changes;
  for (const Explanation& effect : effects) {
    if (!effect.change) continue;
    const Channel& channel = effect.change->channels.front();
    for (int y = 0; y < channel.layout().height; ++y)
      for (int x = 0; x < channel.layout().width; ++x)
        if (const float v = channel.at(x, y); v > 0 && std::isfinite(v)) changes.push_back(v);
  }
  if (changes.empty()) return 0;
  const auto high = changes.begin() + std::ptrdiff_t(0.98 * double(changes.size() - 1));
  std::nth_element(changes.begin(), high, changes.end());
  return *high;
}

cv::Mat tinted(const PanelGround& ground, const Explanation& effect, double largest) {
  cv::Mat image;
  cv::cvtColor(ground.pale, image, cv::COLOR_GRAY2BGR);
  if (!effect.cells && !effect.is_everywhere) return image;
  const std::optional<Cells> cells = cells_of(effect.cells, image.size()),
                             change = cells_of(effect.change, image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (ground.no_surface.at<unsigned char>(y, x) || (cells && !(cells->at(x, y) > 0))) continue;
      const double relative = change && largest > 0 ? change->at(x, y) / largest : 0;
      const double strength = !change ? 1 : relative > 0 ? std::min(relative, 1.0) : 0;
      blend(image.at<cv::Vec3b>(y, x), share_of_tint(strength));
    }
  }
  return image;
}

}  // namespace gloam
