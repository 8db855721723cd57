// What all pictures share: colours, text, planes as 8-bit images, panels, PNG files.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "gloam/frame.h"

namespace gloam {

// --- Colours: blue, green, red, as OpenCV keeps them

inline const cv::Scalar paper(255, 255, 255), ink(34, 34, 34), faint(118, 118, 118), rule(200, 200, 200);
/// Background has no value: it is grey with slanting lines.
inline const cv::Scalar background_tone(214, 214, 214);
inline const cv::Vec3b background_line(186, 186, 186);

// --- Planes as 8-bit images

/// 0 .. 1 to 0 .. 255, clamped. NaN becomes black: a picture must show something.
unsigned char to_byte(double v);

/// Grey for one component; else the first three as red, green and blue: unit vectors as 0.5 + 0.5 n, others clamped to
/// 0..1 through sRGB. A missing component is 0. CV_8UC1 or CV_8UC3.
cv::Mat image_of(const Plane& plane);

/// As `image_of`, always CV_8UC3: grey has three equal channels.
cv::Mat coloured(const Plane& plane);

/// CV_8UC1, CV_8UC2 (grey and alpha, not multiplied by it) or CV_8UC3, written atomically. Throws Error naming `path`.
void write_png(const std::filesystem::path& path, const cv::Mat& image);

/// As `write_png`, into a string.
std::string encode_png(const cv::Mat& image);

/// A PNG of any kind as grey and alpha (CV_8UC2), alpha 255 where it has none. Throws Error naming `path`.
cv::Mat read_png(const std::filesystem::path& path);

// --- Text

enum class Align { left, centre, right };

/// How a piece of text looks. Sizes are heights of capitals in pixels.
struct TextStyle {
  double size;
  cv::Scalar colour = ink;
  bool bold = false;
};

/// Width in pixels.
double text_width(const std::string& text, const TextStyle& style);

/// Writes text with its baseline at `at`.
void put_text(cv::Mat& canvas, const std::string& text, cv::Point at, const TextStyle& style,
              Align align = Align::left);

/// The text with a '?' for each character that the font does not have, and for each byte that is not UTF-8.
std::string drawable(std::string_view text);

/// The text as it can be drawn, without its middle if it is wider than `width`: start and end of a file name matter most.
std::string shortened(const std::string& text, double width, const TextStyle& style);

// --- Panels: images on the paper

/// Limits on the drawn size of an image, pixels.
struct PanelLimits {
  int smallest_box;  ///< narrower images are enlarged towards it by a whole factor
  int largest_box;   ///< wider ones are reduced to it
  int largest_height;
};

/// Size of an image as drawn.
struct PanelSize {
  cv::Size image;         ///< as drawn
  int box = 0;            ///< width kept for it on the sheet
  std::string zoom_note;  ///< for the caption; empty at full size
};

/// Full size if the sheet stays readable; large images are reduced, tiny ones enlarged by a whole factor. A row or column of
/// pixels is widened until it is visible.
PanelSize panel_size(int width, int height, const PanelLimits& limits);

/// How an image is scaled for the sheet.
enum class Sampling { average, point };

/// Slanting lines over an image (CV_8UC3) where `background` (CV_8UC1, of the same size) is set. `unit` scales them.
void hatch(cv::Mat& image, const cv::Mat& background, double unit);

/// Draws an image (CV_8UC3) with a thin frame around it, hatched where `background` (CV_8UC1) is set. Enlarged pixels stay
/// squares; reduced ones are averaged over areas or, for identities, sampled at points. `unit` scales the hatching.
void put_panel(cv::Mat& canvas, const cv::Mat& colours, const cv::Mat& background, cv::Point corner, cv::Size size,
               double unit, Sampling sampling = Sampling::average);

}  // namespace gloam
