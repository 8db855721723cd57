// Text of many lines: sentences broken between words.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "picture/picture.h"

namespace gloam {

/// The text, as it can be drawn, in lines no wider than `width`, broken at white space only. A number keeps its unit ("34 %", "8.1 ms"). A word
/// that is wider by itself has a line of its own, without its middle. No lines for a text without words.
std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style);

/// A text that begins a line.
struct Paragraph {
  std::string text;
  TextStyle style;
};

/// A line and its place.
struct TextLine {
  std::string text;
  TextStyle style;
  cv::Point at;  ///< the baseline's start, middle or end, by `align`; from the block's left top corner
  Align align = Align::left;
};

/// Lines of text in a box.
struct TextBlock {
  std::vector<TextLine> lines;
  int height = 0;  ///< of all lines, pixels
};

/// Paragraphs one below the other, wrapped to `width`.
TextBlock block_of(const std::vector<Paragraph>& paragraphs, int width, Align align = Align::left);

/// Draws a block; its left top corner is at `corner`.
void put_block(cv::Mat& canvas, const TextBlock& block, cv::Point corner);

/// The width of the widest paragraph on one line, pixels.
int natural_width(const std::vector<Paragraph>& paragraphs);

}  // namespace gloam
