#include "gloam/sequence_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/picture.h"

namespace gloam {
namespace {

// Blue, green, red; they differ in brightness too.
const std::array<cv::Scalar, 4> curve_inks = {cv::Scalar(150, 60, 20), cv::Scalar(40, 110, 225),
                                              cv::Scalar(60, 140, 40), cv::Scalar(150, 90, 170)};
const cv::Scalar chart_grid(232, 232, 232), worst_band(215, 225, 250);

constexpr int sheet_width = 1200, sheet_margin = 28, axis_room = 84, top_room = 98, chart_height = 250,
              chart_step = 330, bottom_room = 0;
const TextStyle title_style{14, ink, true}, strong_style{9.5, ink, true}, tick_style{8.5, ink}, facts_style{8.5, faint};

/// The smallest step of 1, 2 or 5 times a power of ten of which `most` at most reach `end`.
double round_step(double end, int most) {
  double step = std::pow(10, std::floor(std::log10(end / most)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (end / step <= most) return step;
    step *= factor;
  }
  return step;
}

/// Where a chart's values and frames lie.
struct ChartArea {
  int x0, x1, y0, y1;  ///< y1 is the base line
  int first, last;     ///< frames
  double step, top;    ///< of the values

  int x(int frame) const {
    const double t = first == last ? 0.5 : double(frame - first) / double(last - first);
    return x0 + cvRound((x1 - x0) * (0.01 + 0.98 * t));
  }
  int y(double value) const { return y1 - cvRound((y1 - y0) * value / top); }
};

ChartArea area_of(const SequencePlot& plot, const SequenceChart& chart, int top) {
  double largest = 0;
  for (const SequenceCurve& curve : chart.curves) {
    for (const std::optional<double>& value : curve.values) largest = std::max(largest, value.value_or(0));
  }
  if (!(largest > 0) || !std::isfinite(largest)) largest = 1e-3;
  const double step = round_step(largest, 5);
  return {sheet_margin + axis_room, sheet_width - sheet_margin, top + 16, top + 16 + chart_height,
          plot.frames.front(),      plot.frames.back(),         step,     step * std::ceil(largest / step + 1e-9)};
}

void draw_values_axis(cv::Mat& canvas, const ChartArea& area) {
  for (int i = 0; i * area.step <= area.top * (1 + 1e-9); ++i) {
    const int y = area.y(i * area.step);
    cv::line(canvas, {area.x0, y}, {area.x1, y}, chart_grid, 1);
    put_text(canvas, fmt::format("{:.4g}", i * area.step), {area.x0 - 7, y + 4}, tick_style, Align::right);
  }
}

void draw_frames_axis(cv::Mat& canvas, const ChartArea& area) {
  cv::line(canvas, {area.x0, area.y1}, {area.x1, area.y1}, ink, 1);
  const int step = std::max(1, cvRound(round_step(std::max(area.last - area.first, 1), 12)));
  for (long frame = (long(area.first) + step - 1) / step * step; frame <= area.last; frame += step) {
    const int x = area.x(int(frame));
    cv::line(canvas, {x, area.y1}, {x, area.y1 + 4}, ink, 1);
    put_text(canvas, std::to_string(frame), {x, area.y1 + 18}, tick_style, Align::centre);
  }
  put_text(canvas, "frame", {(area.x0 + area.x1) / 2, area.y1 + 36}, tick_style, Align::centre);
}

void draw_curve(cv::Mat& canvas, const ChartArea& area, const std::vector<int>& frames, const SequenceCurve& curve,
                const cv::Scalar& colour) {
  std::optional<cv::Point> last;
  const int radius = frames.size() > 150 ? 1 : 3;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (!curve.values[i]) {
      last.reset();
      continue;
    }
    const cv::Point at(area.x(frames[i]), area.y(*curve.values[i]));
    if (last) cv::line(canvas, *last, at, colour, 2, cv::LINE_AA);
    cv::circle(canvas, at, radius, colour, cv::FILLED, cv::LINE_AA);
    last = at;
  }
}

/// Names of the curves behind pieces of their lines, right-aligned at the end of the axis.
void draw_keys(cv::Mat& canvas, const ChartArea& area, const SequenceChart& chart) {
  int right = area.x1;
  for (size_t i = chart.curves.size(); i-- > 0;) {
    const int baseline = area.y0 - 16, left = right - cvRound(text_width(chart.curves[i].name, tick_style));
    put_text(canvas, chart.curves[i].name, {left, baseline}, tick_style);
    cv::line(canvas, {left - 30, baseline - 4}, {left - 8, baseline - 4}, curve_inks[i % curve_inks.size()], 3);
    right = left - 48;
  }
}

void draw_chart(cv::Mat& canvas, const SequencePlot& plot, const SequenceChart& chart, int top) {
  const ChartArea area = area_of(plot, chart, top);
  if (plot.worst) {
    const int x = area.x(*plot.worst);
    cv::rectangle(canvas, {x - 5, area.y0}, {x + 5, area.y1}, worst_band, cv::FILLED);
  }
  draw_values_axis(canvas, area);
  draw_frames_axis(canvas, area);
  put_text(canvas, drawable(chart.title), {sheet_margin, area.y0 - 16}, strong_style);
  draw_keys(canvas, area, chart);
  for (size_t i = 0; i < chart.curves.size(); ++i)
    draw_curve(canvas, area, plot.frames, chart.curves[i], curve_inks[i % curve_inks.size()]);
}

bool has_values(const SequenceChart& chart) {
  return std::any_of(chart.curves.begin(), chart.curves.end(), [](const SequenceCurve& curve) {
    return std::any_of(curve.values.begin(), curve.values.end(), [](const auto& value) { return value.has_value(); });
  });
}

}  // namespace

void write_sequence_plot(const std::filesystem::path& path, const SequencePlot& plot) {
  if (plot.frames.empty()) throw Error("{}: there is no frame to plot", path.string());
  for (const SequenceChart& chart : plot.charts) {
    for (const SequenceCurve& curve : chart.curves) {
      if (curve.values.size() != plot.frames.size())
        throw Error("{}: '{}' has {} values for {} frames; a curve has one for each", path.string(), curve.name,
                    curve.values.size(), plot.frames.size());
    }
  }
  std::vector<const SequenceChart*> charts;  // an empty one would look as if its values were 0
  for (const SequenceChart& chart : plot.charts)
    if (has_values(chart)) charts.push_back(&chart);
  cv::Mat canvas(top_room + chart_step * int(charts.size()) + bottom_room, sheet_width, CV_8UC3, paper);
  constexpr int room = sheet_width - 2 * sheet_margin;
  put_text(canvas, shortened(plot.title, room, title_style), {sheet_margin, 36}, title_style);
  put_text(canvas, shortened(plot.facts, room, facts_style), {sheet_margin, 58}, facts_style);
  for (size_t i = 0; i < charts.size(); ++i) draw_chart(canvas, plot, *charts[i], top_room + chart_step * int(i));
  write_png(path, canvas);
}

}  // namespace gloam
