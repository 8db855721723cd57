#include "picture/heading.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/colours.h"
#include "picture/picture.h"

namespace gloam {
namespace {

/// Round numbers on a logarithmic scale: 1, 2 and 5 of each decade, or all digits if these are fewer than three.
std::vector<double> round_depths(double low, double high) {
  std::vector<double> few, many;
  for (int decade = cvFloor(std::log10(low)); decade <= cvCeil(std::log10(high)); ++decade)
    for (int digit = 1; digit < 10; ++digit) {
      const double v = digit * std::pow(10, decade);
      if (v <= low || v >= high) continue;
      many.push_back(v);
      if (digit == 1 || digit == 2 || digit == 5) few.push_back(v);
    }
  return few.size() < 3 ? many : few;
}

/// Draws ticks with labels below the bar, as far as there is room.
void draw_depth_ticks(cv::Mat& canvas, int x0, int x1, int y, const Range& range, double unit) {
  const auto px = [&](double length) { return cvRound(length * unit); };
  const TextStyle style{8.5 * unit};
  int used = x0 - px(8);
  for (const double depth : round_depths(std::exp(range.first), std::exp(range.last))) {
    const int x = x0 + cvRound((x1 - x0) * range.position(std::log(depth)));
    const std::string label = fmt::format("{:g}", depth);
    const int half = cvCeil(text_width(label, style) / 2);
    if (x - half < used + px(8) || x + half > x1) continue;
    cv::line(canvas, {x, y}, {x, y + px(3)}, ink, 1);
    put_text(canvas, label, {x, y + px(15)}, style, Align::centre);
    used = x + half;
  }
}

/// Draws "depth 1.2 [bar] 14", its left top corner at `at`, at most `width` wide: one scale for all depths of the sheet.
void draw_depth_scale(cv::Mat& canvas, const Range& depths, cv::Point at, int width, double unit) {
  const auto px = [&](double length) { return cvRound(length * unit); };
  const TextStyle style{8.5 * unit};
  const int y0 = at.y, y1 = y0 + px(11), baseline = y1 - px(1);
  const std::string low = "depth  " + figure(std::exp(depths.first)), high = figure(std::exp(depths.last));
  put_text(canvas, low, {at.x, baseline}, style);
  const int x0 = at.x + cvRound(text_width(low, style)) + px(8);
  const int room = at.x + width - x0 - cvRound(text_width(high, style)) - px(8);
  const int x1 = x0 + std::clamp(room, px(16), px(340));
  for (int x = x0; x < x1; ++x) {
    const double t = double(x - x0) / (x1 - x0 - 1);
    cv::line(canvas, {x, y0}, {x, y1 - 1}, cv::Scalar(depth_colour(t)), 1);
  }
  cv::rectangle(canvas, {x0 - 1, y0 - 1}, {x1, y1}, rule, 1);
  put_text(canvas, high, {x1 + px(8), baseline}, style);
  draw_depth_ticks(canvas, x0, x1, y1 + 1, depths, unit);
}

}  // namespace

int heading_height(double unit, bool has_depths) { return cvRound((has_depths ? 108 : 70) * unit); }

void draw_heading(cv::Mat& canvas, const Heading& heading) {
  const auto px = [&](double length) { return cvRound(length * heading.unit); };
  const TextStyle title{14 * heading.unit, ink, true}, small{8.5 * heading.unit, faint};
  const int left = heading.margin, room = canvas.cols - 2 * left;
  put_text(canvas, shortened(heading.title, room, title), {left, px(36)}, title);
  put_text(canvas, fitting(heading.facts, room, small), {left, px(57)}, small);
  if (heading.depths) draw_depth_scale(canvas, *heading.depths, {left, px(72)}, room, heading.unit);
}

}  // namespace gloam
