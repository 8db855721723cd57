#include "picture/picture.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/srgb.h"
#include "base/words.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "picture/letters.h"

namespace gloam {
namespace {

/// to_byte(srgb(v)) for any float, by tables: computing powers would take most of a picture's time.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (int byte = 1; byte < 256; ++byte) steps_.push_back(least_value_of(byte));
    steps_.push_back(std::numeric_limits<float>::infinity());
    for (uint32_t i = 0; i <= bits_of_one >> shift; ++i) {
      const float value = std::bit_cast<float>(i << shift);
      at_.push_back(static_cast<unsigned char>(std::upper_bound(steps_.begin(), steps_.end(), value) - steps_.begin()));
    }
  }

  unsigned char operator()(float v) const {
    if (!(v > 0)) return 0;
    if (v >= 1) return 255;
    const unsigned char byte = at_[std::bit_cast<uint32_t>(v) >> shift];
    return static_cast<unsigned char>(byte + (v >= steps_[byte]));
  }

 private:
  /// Positive floats are in the order of their bits. Floats that are equal but for their last 15 bits are so close that at most
  /// one byte begins among them.
  static constexpr int shift = 15;
  static constexpr uint32_t bits_of_one = std::bit_cast<uint32_t>(1.0f);

  static float least_value_of(int byte) {
    uint32_t below = 0, from = bits_of_one;
    while (from - below > 1) {
      const uint32_t middle = below + (from - below) / 2;
      (to_byte(srgb(std::bit_cast<float>(middle))) < byte ? below : from) = middle;
    }
    return std::bit_cast<float>(from);
  }

  std::vector<float> steps_;       ///< the least value of each byte from 1 on, and a sentinel
  std::vector<unsigned char> at_;  ///< the byte of each float whose last bits are 0
};

unsigned char shown(float v, PlaneKind::Meaning meaning) {
  static const SrgbBytes bytes;
  return meaning == PlaneKind::unit_vector ? to_byte(0.5 + 0.5 * double(v)) : bytes(v);
}

cv::Mat grey_image(const Channel& channel) {
  cv::Mat image(channel.layout().height, channel.layout().width, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) image.at<unsigned char>(y, x) = to_byte(channel.at(x, y));
  return image;
}

/// The first three components as red, green and blue; a missing one is 0.
cv::Mat colour_image(const Plane& plane) {
  const Layout& layout = plane.channels[0].layout();
  const PlaneKind::Meaning meaning = plane_kind(plane.name).meaning;
  cv::Mat image(layout.height, layout.width, CV_8UC3, cv::Scalar::all(0));
  for (size_t c = 0; c < std::min<size_t>(plane.channels.size(), 3); ++c)
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        image.at<cv::Vec3b>(y, x)[int(2 - c)] = shown(plane.channels[c].at(x, y), meaning);
  return image;
}

/// Of text in UTF-8.
std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  for (; !text.empty(); text.remove_prefix(first_character(text).length)) characters += first_character(text).code;
  return characters;
}

/// Share of each pixel that the text covers, with a border of `pad` pixels; the baseline is at `baseline`.
cv::Mat text_coverage(const std::string& text, const TextStyle& style, int pad, int baseline) {
  const int width = int(text_width(text, style)) + 1 + 2 * pad, height = baseline + int(style.size) + pad;
  cv::Mat coverage(height, width, CV_8UC1, cv::Scalar(0));
  letters().draw(coverage, characters_of(text), {pad, baseline}, style.size, style.bold);
  return coverage;
}

void blend(cv::Mat& canvas, const cv::Mat& coverage, cv::Point corner, const cv::Scalar& colour) {
  const cv::Rect inside = cv::Rect(corner, coverage.size()) & cv::Rect({}, canvas.size());
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const double a = coverage.at<unsigned char>(y - corner.y, x - corner.x) / 255.0;
      cv::Vec3b& pixel = canvas.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<unsigned char>(pixel[c] + a * (colour[c] - pixel[c]));
    }
}

/// The least width and height of a panel.
constexpr int thinnest = 24;

cv::Mat resized(const cv::Mat& image, cv::Size size, Sampling sampling) {
  cv::Mat smaller, out;
  const cv::Size least(std::min(size.width, image.cols), std::min(size.height, image.rows));
  cv::resize(image, smaller, least, 0, 0, sampling == Sampling::average ? cv::INTER_AREA : cv::INTER_NEAREST_EXACT);
  cv::resize(smaller, out, size, 0, 0, cv::INTER_NEAREST_EXACT);
  return out;
}

png_image header_of(const cv::Mat& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(image.cols);
  png.height = png_uint_32(image.rows);
  png.format = image.channels() == 1 ? PNG_FORMAT_GRAY : image.channels() == 2 ? PNG_FORMAT_GA : PNG_FORMAT_BGR;
  return png;
}

}  // namespace

unsigned char to_byte(double v) {
  return std::isnan(v) ? 0 : cv::saturate_cast<unsigned char>(std::clamp(v, 0.0, 1.0) * 255);
}

cv::Mat image_of(const Plane& plane) {
  return plane.channels.size() == 1 ? grey_image(plane.channels[0]) : colour_image(plane);
}

cv::Mat coloured(const Plane& plane) {
  cv::Mat image = image_of(plane);
  if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  return image;
}

std::string encode_png(const cv::Mat& image) {
  png_image png = header_of(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.data, png_int_32(image.step[0]), nullptr))
    throw Error("a picture of {}x{} cannot be written as PNG: {}", image.cols, image.rows, png.message);
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const cv::Mat& image) {
  // Encoded in memory, since the codec does not report why a write failed.
  write_text(path, encode_png(image));
}

cv::Mat read_png(const std::filesystem::path& path) {
  check_regular(path);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str()))
    throw Error("{}: cannot be read as PNG: {}", path.string(), png.message);
  opens_file(path);
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&png, png_image_free);
  if ((long long)png.width * png.height > max_pixels)
    throw Error("{}: has {}x{} pixels; {} are read at most", path.string(), png.width, png.height, max_pixels);
  png.format = PNG_FORMAT_GA;
  const unsigned long long bytes = PNG_IMAGE_SIZE(png);
  if (bytes > available_memory())
    throw Error("{}: has {}x{} pixels, which take {} of memory, and {} are available", path.string(), png.width,
                png.height, memory_in_words(bytes), memory_in_words(available_memory()));
  cv::Mat image(int(png.height), int(png.width), CV_8UC2);
  if (!png_image_finish_read(&png, nullptr, image.data, png_int_32(image.step[0]), nullptr))
    throw Error("{}: cannot be read as PNG: {}", path.string(), png.message);
  return image;
}

double text_width(const std::string& text, const TextStyle& style) {
  return letters().width(characters_of(text), style.size, style.bold);
}

void put_text(cv::Mat& canvas, const std::string& text, cv::Point at, const TextStyle& style, Align align) {
  if (text.empty()) return;
  const double width = text_width(text, style);
  const int shift = align == Align::left ? 0 : cvRound(align == Align::centre ? width / 2 : width);
  const int pad = int(style.size / 2) + 1, baseline = int(style.size * 1.5) + 1;
  blend(canvas, text_coverage(text, style, pad, baseline), at - cv::Point(shift + pad, baseline), style.colour);
}

std::string drawable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [code, length] = first_character(text);
    const bool is_character = code != 0xfffd && letters().has(code);
    out += is_character ? text.substr(0, length) : "?";
    text.remove_prefix(length);
  }
  return out;
}

std::string shortened(const std::string& text, double width, const TextStyle& style) {
  const std::string whole = drawable(text);
  std::vector<size_t> starts;
  for (size_t at = 0; at < whole.size(); at += first_character(std::string_view(whole).substr(at)).length)
    starts.push_back(at);
  const size_t all = starts.size(), most = std::min(all, size_t(4 * width / style.size));  // no letter is that narrow
  starts.push_back(whole.size());
  if (most == all && text_width(whole, style) <= width) return whole;
  for (size_t keep = most; keep > 1; --keep) {
    const std::string cut = whole.substr(0, starts[keep - keep / 2]) + "..." + whole.substr(starts[all - keep / 2]);
    if (text_width(cut, style) <= width) return cut;
  }
  return "...";
}

PanelSize panel_size(int width, int height, const PanelLimits& limits) {
  const double shrink = std::min({1.0, double(limits.largest_box) / width, double(limits.largest_height) / height});
  const int grow = std::max(1, std::min({(limits.smallest_box + width - 1) / width, limits.largest_box / width,
                                         limits.largest_box / height}));
  const double scale = shrink < 1 ? shrink : grow;
  PanelSize size;
  size.image = {std::max(thinnest, cvRound(width * scale)), std::max(thinnest, cvRound(height * scale))};
  size.box = std::max(limits.smallest_box, size.image.width);
  if (width * scale < thinnest - 1 || height * scale < thinnest - 1)
    size.zoom_note = "stretched";
  else if (scale > 1)
    size.zoom_note = fmt::format("{} x", grow);
  else if (scale < 1)
    size.zoom_note = fmt::format("{:.0f} %", 100 * scale);
  return size;
}

void hatch(cv::Mat& image, const cv::Mat& background, double unit) {
  const int period = std::max(6, cvRound(7 * unit)), line = std::max(1, cvRound(unit));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (background.at<unsigned char>(y, x) > 127 && (x + y) % period < line)
        image.at<cv::Vec3b>(y, x) = background_line;
}

void put_panel(cv::Mat& canvas, const cv::Mat& colours, const cv::Mat& background, cv::Point corner, cv::Size size,
               double unit, Sampling sampling) {
  cv::Mat image = colours.clone();
  image.setTo(background_tone, background);
  cv::Mat panel = resized(image, size, sampling);
  hatch(panel, resized(background, size, sampling), unit);
  const cv::Rect place(corner, size);
  panel.copyTo(canvas(place));
  cv::rectangle(canvas, place + cv::Point(-1, -1) + cv::Size(2, 2), rule, 1);
}

}  // namespace gloam
