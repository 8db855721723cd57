#include "gloam/explanation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/picture.h"

namespace gloam {
namespace {

/// One colour per effect, distinguishable for the colour-blind too (Okabe, Ito 2008); blue, green, red.
const std::array<cv::Scalar, 5> effect_colours{
    {{0, 159, 230}, {233, 180, 86}, {115, 158, 0}, {167, 121, 204}, {66, 228, 240}}};

constexpr int pad = 24, line = 26, swatch = 18, least_width = 640;
const TextStyle title_style{14, ink, true}, text_style{12}, cost_style{12, faint};

cv::Scalar colour_of(size_t effect) { return effect_colours[effect % effect_colours.size()]; }

/// Grey by the angle between normal and line of sight, or by nearness if there are no normals.
cv::Mat lit_from_the_eye(const View& view) {
  const Channel& depth = view.find("depth")->channels.front();
  const Plane* normal = view.find("normal");
  cv::Mat image(depth.layout().height, depth.layout().width, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double facing = normal ? std::max(0.0f, normal->channels[2].at(x, y)) : 1 / (1 + 0.1 * depth.at(x, y));
      const unsigned char grey = to_byte(0.25 + 0.7 * facing);
      image.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  }
  return image;
}

cv::Mat backdrop_of(const View& view) {
  if (const Plane* colour = view.find("color")) return coloured(*colour);
  cv::Mat image = lit_from_the_eye(view);
  const Channel& depth = view.find("depth")->channels.front();
  cv::Mat background(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) background.at<unsigned char>(y, x) = is_background(depth.at(x, y)) ? 255 : 0;
  }
  image.setTo(background_tone, background);
  hatch(image, background, 1);
  return image;
}

/// Makes an image pale, so that a tint stands out.
void fade(cv::Mat& image) { image.convertTo(image, -1, 0.7, 70); }

/// Whether the tile of a pixel calls for the effect.
bool is_called_for(const Explanation& e, int x, int y, cv::Size image) {
  if (e.is_everywhere || !e.where) return e.is_everywhere;
  const Channel& tiles = e.where->channels.front();
  const int across = (image.width + tiles.layout().width - 1) / tiles.layout().width;
  const int down = (image.height + tiles.layout().height - 1) / tiles.layout().height;
  return tiles.at(x / across, y / down) > 0;
}

void tint(cv::Mat& image, const Explanation& e, const cv::Scalar& colour) {
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (!is_called_for(e, x, y, image.size())) continue;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<unsigned char>(0.5 * pixel[c] + 0.5 * colour[c]);
    }
  }
}

}  // namespace

void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations) {
  if (!view.find("depth")) throw Error("{}: cannot explain a view without depth", path.string());
  cv::Mat image = backdrop_of(view);
  fade(image);
  for (size_t i = 0; i < explanations.size(); ++i) tint(image, explanations[i], colour_of(i));
  // Small images are enlarged to make room for the text.
  const int zoom = std::max(1, least_width / std::max(1, image.cols));
  const cv::Size size(image.cols * zoom, image.rows * zoom);
  const int width = std::max(size.width, least_width);
  const int height = size.height + 2 * pad + int(explanations.size()) * (3 * line + pad / 2);
  cv::Mat canvas(height, width, CV_8UC3, paper);
  cv::Mat enlarged;
  cv::resize(image, enlarged, size, 0, 0, cv::INTER_NEAREST);
  enlarged.copyTo(canvas(cv::Rect(cv::Point((width - size.width) / 2, 0), size)));
  int y = size.height + pad;
  for (size_t i = 0; i < explanations.size(); ++i) {
    const Explanation& e = explanations[i];
    cv::rectangle(canvas, cv::Rect(pad, y, swatch, swatch), colour_of(i), cv::FILLED);
    const int x = pad + swatch + 12, room = width - x - pad;
    put_text(canvas, shortened(e.title, room, title_style), {x, y + 15}, title_style);
    put_text(canvas, shortened(e.why, room, text_style), {x, y + 15 + line}, text_style);
    put_text(canvas, shortened(e.cost, room, cost_style), {x, y + 15 + 2 * line}, cost_style);
    y += 3 * line + pad / 2;
  }
  write_png(path, canvas);
}

}  // namespace gloam
