#include "picture/text_block.h"

#include <algorithm>
#include <sstream>

namespace gloam {
namespace {

bool ends_in_digit(const std::string& text) { return !text.empty() && text.back() >= '0' && text.back() <= '9'; }

/// Pieces between which a line may end: words, and numbers with their units.
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool is_unit = word.rfind('%', 0) == 0 || word.rfind("ms", 0) == 0;
    if (is_unit && !pieces.empty() && ends_in_digit(pieces.back()))
      pieces.back() += " " + drawable(word);
    else
      pieces.push_back(drawable(word));
  }
  return pieces;
}

/// Distance of baselines, and of the first one from the top: room for accents above and for descenders below.
int line_height(const TextStyle& style) { return cvRound(1.85 * style.size); }
int ascent(const TextStyle& style) { return cvRound(1.3 * style.size); }

}  // namespace

std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  for (const std::string& piece : pieces_of(text)) {
    const std::string longer = lines.empty() ? piece : lines.back() + " " + piece;
    if (!lines.empty() && text_width(longer, style) <= width)
      lines.back() = longer;
    else
      lines.push_back(shortened(piece, width, style));
  }
  return lines;
}

TextBlock block_of(const std::vector<Paragraph>& paragraphs, int width, Align align) {
  TextBlock block;
  const int x = align == Align::left ? 0 : align == Align::centre ? width / 2 : width;
  for (const Paragraph& paragraph : paragraphs) {
    for (std::string& line : wrapped(paragraph.text, width, paragraph.style)) {
      const cv::Point at(x, block.height + ascent(paragraph.style));
      block.lines.push_back({std::move(line), paragraph.style, at, align});
      block.height += line_height(paragraph.style);
    }
  }
  return block;
}

void put_block(cv::Mat& canvas, const TextBlock& block, cv::Point corner) {
  for (const TextLine& line : block.lines) put_text(canvas, line.text, corner + line.at, line.style, line.align);
}

int natural_width(const std::vector<Paragraph>& paragraphs) {
  double widest = 0;
  for (const Paragraph& p : paragraphs) widest = std::max(widest, text_width(drawable(p.text), p.style));
  return cvCeil(widest);
}

}  // namespace gloam
