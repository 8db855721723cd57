// Letters of pictures: those of a font of this machine, or OpenCV's strokes where there is none.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace gloam {

/// Draws lines of text. Sizes are heights of capitals in pixels.
class Letters {
 public:
  virtual ~Letters() = default;

  /// Whether there is a letter for a character.
  virtual bool has(char32_t character) const = 0;

  /// Width of a line in pixels; proportional to `size`.
  virtual double width(const std::u32string& text, double size, bool bold) const = 0;

  /// Raises the share of each pixel (CV_8UC1) that a line covers whose baseline begins at `start`. The line lies inside.
  virtual void draw(cv::Mat& coverage, const std::u32string& text, cv::Point start, double size, bool bold) const = 0;
};

/// The letters of all pictures of this process.
const Letters& letters();

/// OpenCV's: strokes, and ASCII only.
std::unique_ptr<Letters> stroke_letters();

}  // namespace gloam
