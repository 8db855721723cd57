#include "picture/letters.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "picture/font.h"

namespace gloam {
namespace {

/// Strokes drawn this many times larger and averaged down have soft edges and any width.
constexpr int oversampling = 4;

class StrokeLetters : public Letters {
 public:
  bool has(char32_t character) const override { return character >= 32 && character < 127; }

  double width(const std::u32string& text, double size, bool bold) const override {
    const std::string line(text.begin(), text.end());
    const cv::Size pixels = cv::getTextSize(line, font, scale(size), stroke(size, bold), nullptr);
    return double(pixels.width) / oversampling;
  }

  void draw(cv::Mat& coverage, const std::u32string& text, cv::Point start, double size, bool bold) const override {
    cv::Mat large(coverage.size() * oversampling, CV_8UC1, cv::Scalar(0)), small;
    cv::putText(large, std::string(text.begin(), text.end()), start * oversampling, font, scale(size), cv::Scalar(255),
                stroke(size, bold), cv::LINE_AA);
    cv::resize(large, small, coverage.size(), 0, 0, cv::INTER_AREA);
    cv::max(coverage, small, coverage);
  }

 private:
  static constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
  static double scale(double size) { return size * oversampling / 21; }
  static int stroke(double size, bool bold) {
    return std::max(1, cvRound(size * oversampling * (bold ? 0.19 : 0.115)));
  }
};

}  // namespace

std::unique_ptr<Letters> stroke_letters() { return std::make_unique<StrokeLetters>(); }

const Letters& letters() {
  static const std::unique_ptr<Letters> of_font = font_letters(), of_strokes = stroke_letters();
  return of_font ? *of_font : *of_strokes;
}

}  // namespace gloam
