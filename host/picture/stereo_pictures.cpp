#include "gloam/stereo_pictures.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "gloam/error.h"
#include "picture/inconsistency_image.h"
#include "picture/picture.h"

namespace gloam {
namespace {

/// Both planes as images of three colours, left first.
std::array<cv::Mat, 2> pair_of(const std::filesystem::path& path, const Plane& left, const Plane& right) {
  std::array<cv::Mat, 2> images = {coloured(left), coloured(right)};
  if (images[0].size() != images[1].size())
    throw Error("{}: not written: the left image is {}x{} and the right one {}x{}", path.string(), images[0].cols,
                images[0].rows, images[1].cols, images[1].rows);
  return images;
}

// --- The legend

constexpr int key_margin = 8, row_height = 20, swatch_width = 60, swatch_height = 12;
const TextStyle words{8, ink};

/// An entry of the legend: a field of colours and its meaning.
struct Key {
  std::string text;
  cv::Mat swatch;
};

cv::Mat plain_swatch(const cv::Scalar& colour) { return {swatch_height, swatch_width / 2, CV_8UC3, colour}; }

std::vector<Key> keys_of(double magnify) {
  cv::Mat scale(swatch_height, swatch_width, CV_8UC3);
  for (int x = 0; x < scale.cols; ++x) scale.col(x).setTo(cv::Scalar::all(to_byte(double(x) / (scale.cols - 1))));
  cv::Mat hidden = plain_swatch(hidden_tone(cv::Vec3b::all(255))), background = plain_swatch(background_tone);
  hidden.colRange(0, hidden.cols / 2).setTo(cv::Scalar(hidden_tone(cv::Vec3b::all(0))));
  hatch(background, cv::Mat(background.size(), CV_8UC1, cv::Scalar(255)), 1);
  return {{fmt::format("difference between the eyes, 0 to {:.3g} (x {:g})", 1 / magnify, magnify), scale},
          {"does not count: one eye alone sees it, or an edge", hidden},
          {"no surface", background}};
}

int width_of(const Key& key) { return key.swatch.cols + 6 + cvCeil(text_width(key.text, words)); }

/// Positions of the entries: from left to right, in as many rows as needed.
std::vector<cv::Point> places_of(const std::vector<Key>& keys, int width) {
  std::vector<cv::Point> places;
  cv::Point at(key_margin, key_margin);
  for (const Key& key : keys) {
    if (at.x > key_margin && at.x + width_of(key) + key_margin > width) at = {key_margin, at.y + row_height};
    places.push_back(at);
    at.x += width_of(key) + 18;
  }
  return places;
}

cv::Mat with_legend(const cv::Mat& image, double magnify) {
  const std::vector<Key> keys = keys_of(magnify);
  int width = image.cols;
  for (const Key& key : keys) width = std::max(width, width_of(key) + 2 * key_margin);
  const std::vector<cv::Point> places = places_of(keys, width);
  cv::Mat sheet(image.rows + places.back().y + row_height, width, CV_8UC3, paper);
  image.copyTo(sheet(cv::Rect({}, image.size())));
  for (size_t i = 0; i < keys.size(); ++i) {
    const cv::Rect field(places[i] + cv::Point(0, image.rows), keys[i].swatch.size());
    keys[i].swatch.copyTo(sheet(field));
    cv::rectangle(sheet, field, rule, 1);
    put_text(sheet, keys[i].text, {field.br().x + 6, field.br().y - 2}, words);
  }
  return sheet;
}

}  // namespace

void write_inconsistency_picture(const std::filesystem::path& path, const Plane& shown, const StereoErrors& errors,
                                 double magnify) {
  write_png(path, with_legend(inconsistency_image(shown, errors, magnify), magnify));
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
