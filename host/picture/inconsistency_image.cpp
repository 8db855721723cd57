#include "picture/inconsistency_image.h"

#include "picture/picture.h"

namespace gloam {
namespace {

/// Blue, green, red.
const cv::Vec3d purple(200, 40, 150);

}  // namespace

cv::Vec3b hidden_tone(const cv::Vec3b& colour) {
  cv::Vec3b out;
  for (int c = 0; c < 3; ++c) out[c] = cv::saturate_cast<unsigned char>(0.5 * (colour[c] + purple[c]));
  return out;
}

cv::Mat inconsistency_image(const Plane& shown, const StereoErrors& errors, double magnify) {
  cv::Mat image = coloured(shown), background(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const StereoPixel pixel = errors.pixels[size_t(y) * size_t(image.cols) + size_t(x)];
      background.at<unsigned char>(y, x) = pixel == StereoPixel::background ? 255 : 0;
      cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      colour = pixel == StereoPixel::counted ? cv::Vec3b::all(to_byte(magnify * double(errors.error.at(x, y))))
                                             : hidden_tone(colour);
    }
  }
  image.setTo(background_tone, background);
  hatch(image, background, 1);
  return image;
}

}  // namespace gloam
