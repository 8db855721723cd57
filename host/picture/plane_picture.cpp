#include "gloam/plane_picture.h"

#include <opencv2/core.hpp>

#include "gloam/error.h"
#include "picture/picture.h"

namespace gloam {

void write_picture(const std::filesystem::path& path, const Plane& plane, const Plane* depth) {
  if (plane.channels.empty() || plane.channels[0].layout().count() <= 2 * size_t(Layout::guard))
    throw Error("{}: '{}' has no pixels to write", path.string(), plane.name);
  cv::Mat image = image_of(plane);
  if (depth && depth->channels[0].layout() == plane.channels[0].layout()) {
    cv::Mat background(image.rows, image.cols, CV_8UC1);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        background.at<unsigned char>(y, x) = is_background(depth->channels[0].at(x, y)) ? 255 : 0;
    if (cv::countNonZero(background) > 0) {
      image = coloured(plane);
      image.setTo(background_tone, background);
      hatch(image, background, 1);
    }
  }
  write_png(path, image);
}

}  // namespace gloam
