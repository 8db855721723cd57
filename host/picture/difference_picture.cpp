#include "gloam/difference_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "picture/differences.h"
#include "picture/picture.h"

namespace gloam {
namespace {

// Colours (blue, green, red, as OpenCV keeps them)
const cv::Scalar grid(232, 232, 232), bar_fill(190, 175, 165);
const cv::Scalar bias_ink(30, 120, 20), rmse_ink(150, 60, 130);

constexpr PanelLimits panel_limits{320, 1280, 2560};

/// A white sheet. All lengths are multiples of `unit`, so that it looks the same at any size.
struct Sheet {
  cv::Mat canvas;
  double unit = 1;
  PanelSize panel;
  bool light = true;  ///< the plane is brightness: differences are "too dark" and "too bright"

  int px(double length) const { return cvRound(length * unit); }
  int margin() const { return px(24); }
  int gap() const { return px(18); }
  int column(int i) const { return margin() + i * (panel.box + gap()); }
  int width() const { return column(2) + panel.box + margin(); }
  int panels_top() const { return px(98); }
  int lower_top() const { return panels_top() + panel.image.height + px(24); }
  int height() const { return lower_top() + px(248); }
  TextStyle title() const { return {14 * unit, ink, true}; }
  TextStyle text() const { return {9.5 * unit}; }
  TextStyle strong() const { return {9.5 * unit, ink, true}; }
  TextStyle small() const { return {8.5 * unit, faint}; }
  TextStyle tick() const { return {8.5 * unit, ink}; }
};

Sheet blank_sheet(const Differences& d) {
  Sheet sheet;
  sheet.panel = panel_size(d.width, d.height, panel_limits);
  sheet.unit = std::clamp(sheet.panel.box / 420.0, 1.0, 1.9);
  const PlaneKind::Meaning meaning = plane_kind(d.test.name).meaning;
  sheet.light = meaning != PlaneKind::unit_vector && meaning != PlaneKind::view_depth;
  sheet.canvas = cv::Mat(sheet.height(), sheet.width(), CV_8UC3, paper);
  return sheet;
}

/// 1234567 as "1 234 567".
std::string grouped(long long n) {
  std::string digits = std::to_string(n);
  for (int i = int(digits.size()) - 3; i > 0; i -= 3) digits.insert(size_t(i), " ");
  return digits;
}

std::string with_sign(double v) { return v == 0 ? "0" : fmt::format("{:+.4g}", v); }

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

void draw_title(Sheet& sheet, const Differences& d, const DifferencePicture& options) {
  const TextStyle style = sheet.title();
  const std::string between = "  against  ";
  const double room = (sheet.width() - 2 * sheet.margin() - text_width(between, style)) / 2;
  const std::string title =
      shortened(options.test_name, room, style) + between + shortened(options.truth_name, room, style);
  put_text(sheet.canvas, title, {sheet.margin(), sheet.px(38)}, style);
  const long long pixels = std::count_if(d.foreground.begin(), d.foreground.end(), [](auto m) { return m != 0; });
  const long long all = static_cast<long long>(d.foreground.size());
  std::string facts = fmt::format("{}, {} x {} pixels", drawable(d.test.name), d.width, d.height);
  if (pixels < all)
    facts += fmt::format("; {} % background (hatched) does not count",
                         fmt::format("{:.3g}", 100.0 * double(all - pixels) / double(all)));
  put_text(sheet.canvas, shortened(facts, sheet.width() - 2 * sheet.margin(), sheet.small()),
           {sheet.margin(), sheet.px(60)}, sheet.small());
}

void draw_panel(Sheet& sheet, int column, const cv::Mat& picture, const cv::Mat& background, const std::string& label,
                const std::string& name) {
  cv::Mat colours = picture;
  if (picture.channels() == 1) cv::cvtColor(picture, colours, cv::COLOR_GRAY2BGR);
  const cv::Point corner(sheet.column(column) + (sheet.panel.box - sheet.panel.image.width) / 2, sheet.panels_top());
  put_panel(sheet.canvas, colours, background, corner, sheet.panel.image, sheet.unit);

  const cv::Point caption(sheet.column(column), sheet.panels_top() - sheet.px(9));
  put_text(sheet.canvas, label, caption, sheet.strong());
  const int used = cvRound(text_width(label, sheet.strong())) + sheet.px(9);
  put_text(sheet.canvas, shortened(name, sheet.panel.box - used, sheet.small()), caption + cv::Point(used, 0),
           sheet.small());
}

Plane brightened(const Plane& plane, double exposure) {
  Plane out = plane.clone();
  if (exposure > 0) {
    for (Channel& channel : out.channels) {
      for (int y = 0; y < channel.layout().height; ++y)
        for (int x = 0; x < channel.layout().width; ++x) channel.at(x, y) *= float(exposure);
    }
  }
  return out;
}

void draw_panels(Sheet& sheet, const Differences& d, double range, const DifferencePicture& options) {
  cv::Mat background(d.height, d.width, CV_8UC1);
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) background.at<unsigned char>(y, x) = d.counts(x, y) ? 0 : 255;
  const std::string note = sheet.panel.zoom_note.empty() ? "" : " (" + sheet.panel.zoom_note + ")";
  const std::string scale = options.exposure > 0 ? fmt::format(" x {:.3g}", options.exposure) : "";
  draw_panel(sheet, 0, image_of(brightened(d.test, options.exposure)), background, "Test" + scale,
             options.test_name + note);
  draw_panel(sheet, 1, image_of(brightened(d.truth, options.exposure)), background, "Truth" + scale,
             options.truth_name + note);
  draw_panel(sheet, 2, difference_image(d, range), background, "Difference",
             d.components == 1 ? "test - truth" : "test - truth, component that differs most");
}

std::string tick_label(double v) { return v == 0 ? "0" : fmt::format("{:+.3g}", v); }

/// Five ticks with labels under a horizontal axis of differences; the outer labels stay within the axis.
void draw_difference_ticks(Sheet& sheet, int x0, int x1, int y, double range) {
  for (int i = -2; i <= 2; ++i) {
    const int x = x0 + cvRound((x1 - x0) * (i + 2) / 4.0);
    cv::line(sheet.canvas, {x, y}, {x, y + sheet.px(4)}, ink, 1);
    const Align align = i == -2 ? Align::left : i == 2 ? Align::right : Align::centre;
    put_text(sheet.canvas, tick_label(range * i / 2), {x, y + sheet.px(17)}, sheet.tick(), align);
  }
}

void draw_scale_bar(Sheet& sheet, double range, const Histogram& histogram) {
  const int x0 = sheet.column(2), x1 = x0 + sheet.panel.box, y0 = sheet.lower_top(), y1 = y0 + sheet.px(13);
  for (int x = x0; x < x1; ++x) {
    const double t = 2.0 * (x - x0) / std::max(1, x1 - x0 - 1) - 1;
    cv::line(sheet.canvas, {x, y0}, {x, y1}, cv::Scalar(difference_colour(t)), 1);
  }
  cv::rectangle(sheet.canvas, {x0 - 1, y0 - 1}, {x1, y1}, rule, 1);
  draw_difference_ticks(sheet, x0, x1 - 1, y1, range);
  const int words = y1 + sheet.px(34);
  put_text(sheet.canvas, sheet.light ? "too dark" : "too low", {x0, words}, sheet.text());
  put_text(sheet.canvas, sheet.light ? "too bright" : "too high", {x1, words}, sheet.text(), Align::right);
  if (histogram.beyond > 0) {
    const double share = double(histogram.beyond) / double(histogram.all);
    put_text(sheet.canvas, share < 1e-4 ? "< 0.01 % beyond" : percent(share) + " beyond", {(x0 + x1) / 2, words},
             sheet.small(), Align::centre);
  }
}

void draw_upright(cv::Mat& canvas, int x, int y0, int y1, const cv::Scalar& colour, int thickness, int dash) {
  for (int y = y0; y < y1; y += 2 * dash)
    cv::rectangle(canvas, cv::Rect(x - thickness / 2, y, thickness, std::min(dash, y1 - y)), colour, cv::FILLED);
}

/// Area of the histogram. Heights are logarithmic: a few far-off pixels are of most interest.
struct Plot {
  int x0, x1, y0, y1;  ///< y1 is the base line
  double range, top;   ///< ends of the axes: difference, log10 of the count
  static constexpr double bottom = -0.3;
  int x(double difference) const { return x0 + cvRound((x1 - x0) * (difference / range + 1) / 2); }
  int y(double count) const { return y1 - cvRound((y1 - y0) * (std::log10(count) - bottom) / (top - bottom)); }
};

void draw_count_axis(Sheet& sheet, const Plot& plot) {
  for (int decade = 0; decade <= int(plot.top); ++decade) {
    const int y = plot.y(std::pow(10, decade));
    cv::line(sheet.canvas, {plot.x0, y}, {plot.x1, y}, grid, 1);
    const std::string label = grouped(std::llround(std::pow(10, decade)));
    put_text(sheet.canvas, label, {plot.x0 - sheet.px(6), y + sheet.px(4)}, sheet.tick(), Align::right);
  }
}

void draw_bars(Sheet& sheet, const Plot& plot, const Histogram& histogram) {
  const double width = double(plot.x1 - plot.x0) / double(histogram.bins.size());
  for (size_t i = 0; i < histogram.bins.size(); ++i) {
    if (histogram.bins[i] == 0) continue;
    const int left = plot.x0 + cvRound(width * double(i)), right = plot.x0 + cvRound(width * double(i + 1));
    cv::rectangle(sheet.canvas, cv::Rect(cv::Point(left, plot.y(double(histogram.bins[i]))), cv::Point(right, plot.y1)),
                  bar_fill, cv::FILLED);
  }
}

/// Draws a short piece of a line and its meaning, right-aligned at `right`. Returns the left end.
int draw_key(Sheet& sheet, int right, int baseline, const std::string& text, const cv::Scalar& colour, bool dashed) {
  put_text(sheet.canvas, text, {right, baseline}, sheet.tick(), Align::right);
  const int x = right - cvRound(text_width(text, sheet.tick())) - sheet.px(9), thickness = std::max(2, sheet.px(1.6));
  draw_upright(sheet.canvas, x, baseline - sheet.px(10), baseline + sheet.px(2), colour, thickness,
               dashed ? sheet.px(3) : sheet.px(20));
  return x - sheet.px(16);
}

/// Draws zero, bias and spread. Lines outside the axis are left out; the key still gives their numbers.
void draw_marks(Sheet& sheet, const Plot& plot, const Metrics& metrics) {
  const auto mark = [&](double v, const cv::Scalar& colour, double thickness, bool dashed) {
    if (std::abs(v) > plot.range) return;
    draw_upright(sheet.canvas, plot.x(v), plot.y0, plot.y1, colour, std::max(1, sheet.px(thickness)),
                 dashed ? sheet.px(4) : plot.y1 - plot.y0);
  };
  mark(0, ink, 1, false);
  mark(-metrics.rmse, rmse_ink, 1.6, true);
  mark(metrics.rmse, rmse_ink, 1.6, true);
  mark(metrics.bias, bias_ink, 1.6, false);
}

void draw_histogram(Sheet& sheet, const Differences& d, const Histogram& histogram, const Metrics& metrics,
                    double range) {
  const double top = std::max(1.0, std::log10(double(std::max(1LL, histogram.largest)))) + 0.12;
  const int label_width = cvRound(text_width(grouped(std::llround(std::pow(10, std::floor(top)))), sheet.tick()));
  const Plot plot{sheet.column(0) + label_width + sheet.px(8),
                  sheet.column(1) + sheet.panel.box - sheet.px(12),
                  sheet.lower_top() + sheet.px(18),
                  sheet.lower_top() + sheet.px(176),
                  range,
                  top};
  const int header = sheet.lower_top() + sheet.px(8);
  put_text(sheet.canvas, d.components == 1 ? "Pixels per bin, log scale" : "Values per bin, log scale",
           {sheet.column(0), header}, sheet.strong());
  int right = plot.x1;
  right = draw_key(sheet, right, header, fmt::format("+-RMSE {:.4g}", metrics.rmse), rmse_ink, true);
  right = draw_key(sheet, right, header, "bias " + with_sign(metrics.bias), bias_ink, false);
  draw_key(sheet, right, header, "zero", ink, false);
  draw_count_axis(sheet, plot);
  draw_bars(sheet, plot, histogram);
  draw_marks(sheet, plot, metrics);
  cv::line(sheet.canvas, {plot.x0, plot.y1}, {plot.x1, plot.y1}, ink, 1);
  draw_difference_ticks(sheet, plot.x0, plot.x1, plot.y1, range);
  const char* ends = histogram.beyond > 0 ? " (the end bars also hold all that lies beyond)" : "";
  put_text(sheet.canvas, fmt::format("Difference, test - truth{}", ends),
           {(plot.x0 + plot.x1) / 2, plot.y1 + sheet.px(36)}, sheet.text(), Align::centre);
}

using Row = std::pair<std::string, std::string>;

std::vector<Row> figures(const Metrics& m) {
  std::vector<Row> rows = {{"pixels", grouped(m.pixels)},
                           {"RMSE", fmt::format("{:.4g}", m.rmse)},
                           {"MAE", fmt::format("{:.4g}", m.mae)},
                           {"bias", with_sign(m.bias)},
                           {"largest", fmt::format("{:.4g}", m.max)},
                           {"PSNR", m.psnr ? fmt::format("{:.2f} dB", *m.psnr) : "identical"},
                           {"SSIM", fmt::format("{:.4f}", m.ssim)},
                           {"GMSD", fmt::format("{:.4f}", m.gmsd)},
                           {"> 1/255", percent(m.over_1_255)},
                           {"> 0.05", percent(m.over_0_05)}};
  if (m.flip) rows.emplace_back("FLIP", fmt::format("{:.4f}", *m.flip));
  if (m.rse) rows.emplace_back("RSE", fmt::format("{:.4g}", *m.rse));
  return rows;
}

/// Two columns of names and numbers between rules.
void draw_table(Sheet& sheet, const Metrics& metrics) {
  const std::vector<Row> rows = figures(metrics);
  const int lines = int(rows.size() + 1) / 2, step = sheet.px(21), x0 = sheet.column(2), x1 = x0 + sheet.panel.box;
  const int top = sheet.lower_top() + sheet.px(68), gap = sheet.px(20), half = (x1 - x0 - gap) / 2;
  for (const int y : {top, top + lines * step + sheet.px(8)})
    cv::rectangle(sheet.canvas, cv::Rect(x0, y, x1 - x0, std::max(1, sheet.px(1.2))), ink, cv::FILLED);
  for (int i = 0; i < int(rows.size()); ++i) {
    const int left = x0 + i / lines * (half + gap), y = top + (i % lines + 1) * step - sheet.px(1);
    put_text(sheet.canvas, rows[size_t(i)].first, {left, y}, sheet.text());
    put_text(sheet.canvas, rows[size_t(i)].second, {left + half, y}, sheet.text(), Align::right);
    if (i % lines + 1 < lines) cv::line(sheet.canvas, {left, y + sheet.px(7)}, {left + half, y + sheet.px(7)}, grid, 1);
  }
}

}  // namespace

void write_difference_picture(const std::filesystem::path& path, const Plane& test, const Plane& truth,
                              const Mask& foreground, const Metrics& metrics, const DifferencePicture& options) {
  const Differences d = differences(test, truth, foreground);
  const double range = options.range > 0 ? options.range : fitting_range(d);
  Sheet sheet = blank_sheet(d);
  const Histogram histogram = histogram_of(d, range, 101);
  draw_title(sheet, d, options);
  draw_panels(sheet, d, range, options);
  draw_histogram(sheet, d, histogram, metrics, range);
  draw_scale_bar(sheet, range, histogram);
  draw_table(sheet, metrics);
  write_png(path, sheet.canvas);
}

double difference_range(const Plane& test, const Plane& truth, const Mask& foreground) {
  return fitting_range(differences(test, truth, foreground));
}

}  // namespace gloam
