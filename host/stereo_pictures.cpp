#include "gloam/stereo_pictures.h"

#include <array>
#include <opencv2/core.hpp>

#include "gloam/error.h"
#include "inconsistency_image.h"
#include "picture.h"

namespace gloam {
namespace {

/// Blue, green, red. What does not count is this at half strength over the plane: it stays dark where that is dark, and
/// purple where that is bright.
const cv::Vec3d purple(200, 40, 150);

cv::Vec3b toned(const cv::Vec3b& colour) {
  cv::Vec3b out;
  for (int c = 0; c < 3; ++c) out[c] = cv::saturate_cast<unsigned char>(0.5 * (colour[c] + purple[c]));
  return out;
}

/// Both as images of three colours, left first.
std::array<cv::Mat, 2> pair_of(const std::filesystem::path& path, const Plane& left, const Plane& right) {
  std::array<cv::Mat, 2> images = {coloured(left), coloured(right)};
  if (images[0].size() != images[1].size())
    throw Error("{}: not written: the left image is {}x{} and the right one {}x{}", path.string(), images[0].cols,
                images[0].rows, images[1].cols, images[1].rows);
  return images;
}

}  // namespace

cv::Mat inconsistency_image(const Plane& shown, const StereoErrors& errors, double magnify) {
  cv::Mat image = coloured(shown), background(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const StereoPixel pixel = errors.pixels[size_t(y) * size_t(image.cols) + size_t(x)];
      background.at<unsigned char>(y, x) = pixel == StereoPixel::background ? 255 : 0;
      cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      colour = pixel == StereoPixel::counted ? cv::Vec3b::all(to_byte(magnify * double(errors.error.at(x, y))))
                                             : toned(colour);
    }
  }
  image.setTo(background_tone, background);
  hatch(image, background, 1);
  return image;
}

void write_inconsistency_picture(const std::filesystem::path& path, const Plane& shown, const StereoErrors& errors,
                                 double magnify) {
  write_png(path, inconsistency_image(shown, errors, magnify));
}

void write_anaglyph(const std::filesystem::path& path, const Plane& left, const Plane& right) {
  const std::array<cv::Mat, 2> images = pair_of(path, left, right);
  cv::Mat out = images[1].clone();
  const int from_red_to_red[] = {2, 2};
  cv::mixChannels(&images[0], 1, &out, 1, from_red_to_red, 1);
  write_png(path, out);
}

void write_side_by_side(const std::filesystem::path& path, const Plane& left, const Plane& right) {
  const std::array<cv::Mat, 2> images = pair_of(path, left, right);
  cv::Mat out;
  cv::hconcat(images[0], images[1], out);
  write_png(path, out);
}

}  // namespace gloam
