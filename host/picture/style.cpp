#include "picture/style.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <unordered_set>

#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

// ---------------------------------------------------------------------------------------------------------------------
// What planes mean

struct NamedLook {
  const char* plane;
  size_t components;
  Look look;
};

/// Planes whose kind says too little. One with another number of components is drawn as what it has.
constexpr std::array<NamedLook, 5> named_looks{{{"instance", 1, Look::identity},
                                                {"peel_count", 1, Look::count},
                                                {"outline_count", 1, Look::count},
                                                {"position", 3, Look::position},
                                                {"motion", 2, Look::motion}}};

Look look_of(const Plane& plane) {
  const size_t components = plane.channels.size();
  for (const NamedLook& named : named_looks)
    if (plane.name == named.plane && components == named.components) return named.look;
  const PlaneKind::Meaning meaning = plane_kind(plane.name).meaning;
  if (components > 1) return meaning == PlaneKind::unit_vector ? Look::direction : Look::colour;
  if (meaning == PlaneKind::view_depth) return Look::depth;
  return meaning == PlaneKind::unit_interval ? Look::share : Look::scalar;
}

/// The sky has a colour and a coverage.
bool background_has_value(const Plane& plane) { return plane.name == "color" || plane.name == "alpha"; }

/// The number that is drawn of a component; NaN where there is none.
double value_at(const Plane& plane, Look look, size_t component, int x, int y) {
  const double v = plane.channels[component].at(x, y);
  if (look == Look::depth) return v > 0 ? std::log(v) : std::numeric_limits<double>::quiet_NaN();
  if (look == Look::motion) return std::hypot(v, double(plane.channels[1].at(x, y)));
  return v;
}

/// Motion has one number, its length; so has everything of one component.
size_t components_of(const Plane& plane, Look look) { return look == Look::motion ? 1 : plane.channels.size(); }

const Channel* background_of(const View& view, const Plane& plane, Look look) {
  if (look == Look::depth) return &plane.channels[0];
  const Plane* depth = view.find("depth");
  return depth && !depth->channels.empty() && !background_has_value(plane) ? &depth->channels[0] : nullptr;
}

}  // namespace

Tile tile_of(const View& view, const Plane& plane) {
  const Look look = look_of(plane);
  return {&view, &plane, look, background_of(view, plane, look)};
}

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// Ranges

/// Values looked at to find the ends of the colours.
constexpr size_t sample_size = 200'000;

/// Ends of the colours: the range, or without the outermost 1 % of the values where that is less than half of it. A few
/// outliers must not wash out all the rest. Positions go without their outermost 10 %: what lies near the horizon is few
/// pixels and most of the range.
void choose_ends(Range& range, std::vector<float>& sample, Look look) {
  range.first = range.low;
  range.last = range.high;
  if (sample.empty()) return;
  std::sort(sample.begin(), sample.end());
  const size_t outside = sample.size() / (look == Look::position ? 20 : 200);
  const double first = sample[outside], last = sample[sample.size() - 1 - outside];
  const bool much_narrower = last - first < 0.5 * (range.high - range.low);
  if (last <= first || (look != Look::position && !much_narrower)) return;
  range.first = first;
  range.last = last;
}

/// Values of one component, and every so many of them for the ends of the colours.
struct Values {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<float> sample;
};

Values values_of(const Tile& tile, size_t component, long long step) {
  Values values;
  Range& range = values.range;
  for (int y = 0; y < tile.layout().height; ++y)
    for (int x = 0; x < tile.layout().width; ++x) {
      if (tile.is_background(x, y)) continue;
      const double v = value_at(*tile.plane, tile.look, component, x, y);
      if (!std::isfinite(v)) continue;
      range.low = std::min(range.low, v);
      range.high = std::max(range.high, v);
      if (range.finite++ % step == 0) values.sample.push_back(float(v));
    }
  return values;
}

/// Over the tiles that are drawn on one scale.
Range range_of(const std::vector<const Tile*>& tiles, size_t component) {
  size_t pixels = 0;
  for (const Tile* tile : tiles) pixels += size_t(tile->layout().width) * size_t(tile->layout().height);
  const long long step = 1 + (long long)(pixels / sample_size);
  std::vector<Values> of_tiles(tiles.size());
  cv::parallel_for_(cv::Range(0, int(tiles.size())), [&](const cv::Range& part) {
    for (int i = part.start; i < part.end; ++i) of_tiles[size_t(i)] = values_of(*tiles[size_t(i)], component, step);
  });
  Values all;
  for (const Values& values : of_tiles) {
    all.range.low = std::min(all.range.low, values.range.low);
    all.range.high = std::max(all.range.high, values.range.high);
    all.range.finite += values.range.finite;
    all.sample.insert(all.sample.end(), values.sample.begin(), values.sample.end());
  }
  if (all.range.finite == 0) all.range.low = all.range.high = 0;
  choose_ends(all.range, all.sample, tiles.front()->look);
  return all.range;
}

const std::string depth_key = "all depths";

}  // namespace

double Range::position(double v) const {
  return last > first ? std::clamp((v - first) / (last - first), 0.0, 1.0) : 0.5;
}

std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles) {
  std::vector<Range> ranges;
  const Tile& first = *tiles.front();
  for (size_t c = 0; c < components_of(*first.plane, first.look); ++c) ranges.push_back(range_of(tiles, c));
  return ranges;
}

std::string scale_key(const Tile& tile) {
  return tile.look == Look::depth ? depth_key : fmt::format("{} {}", tile.plane->name, tile.plane->channels.size());
}

Scales scales_of(const std::vector<Tile>& tiles) {
  std::map<std::string, std::vector<const Tile*>> alike;
  for (const Tile& tile : tiles) alike[scale_key(tile)].push_back(&tile);
  Scales scales;
  for (const auto& [key, group] : alike) scales[key] = ranges_of(group);
  return scales;
}

const Range* depth_scale(const Scales& scales) {
  const auto found = scales.find(depth_key);
  return found == scales.end() ? nullptr : &found->second.front();
}

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// Colours

/// A foreground value that is not a number, or not positive where it has to be: no colour of any scale.
const cv::Vec3b not_finite_colour(255, 0, 255);

using ColourTable = std::array<cv::Vec3b, 256>;

ColourTable colour_table(cv::ColormapTypes map) {
  cv::Mat grey(1, 256, CV_8UC1), colours;
  for (int i = 0; i < 256; ++i) grey.at<unsigned char>(0, i) = static_cast<unsigned char>(i);
  cv::applyColorMap(grey, colours, map);
  ColourTable table;
  for (int i = 0; i < 256; ++i) table[size_t(i)] = colours.at<cv::Vec3b>(0, i);
  return table;
}

/// Both run evenly from dark to bright, also for those who see few colours.
const ColourTable& depth_colours() {
  static const ColourTable table = colour_table(cv::COLORMAP_VIRIDIS);
  return table;
}
const ColourTable& count_colours() {
  static const ColourTable table = colour_table(cv::COLORMAP_INFERNO);
  return table;
}

cv::Vec3b grey(double t) { return cv::Vec3b::all(to_byte(t)); }
cv::Vec3b red_green_blue(double r, double g, double b) { return {to_byte(b), to_byte(g), to_byte(r)}; }

/// `hue` in turns, red at 0; the others 0 to 1.
cv::Vec3b hue_colour(double hue, double saturation, double brightness) {
  const auto component = [&](double offset) {
    const double ramp = std::abs(6 * (hue + offset - std::floor(hue + offset)) - 3) - 1;
    return brightness * (1 - saturation * (1 - std::clamp(ramp, 0.0, 1.0)));
  };
  return red_green_blue(component(0), component(2.0 / 3), component(1.0 / 3));
}

/// A colour for an identity. Neighbouring numbers get unlike colours: their bits are mixed first (the finaliser of
/// MurmurHash3).
cv::Vec3b identity_colour(float id) {
  uint32_t h = std::bit_cast<uint32_t>(id);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  return hue_colour((h & 0xffff) / 65536.0, 0.35 + 0.35 * ((h >> 16) & 0xff) / 255, 0.6 + 0.35 * (h >> 24) / 255);
}

cv::Vec3b motion_colour(double x, double y, const Range& length) {
  const double turns = std::atan2(y, x) / (2 * CV_PI), longest = length.last > 0 ? length.last : 1;
  return hue_colour(turns, 0.85, std::min(std::hypot(x, y) / longest, 1.0));
}

cv::Vec3b position_colour(const Plane& plane, const std::vector<Range>& ranges, int x, int y) {
  std::array<double, 3> t;
  for (size_t c = 0; c < 3; ++c) t[c] = ranges[c].position(plane.channels[c].at(x, y));
  return red_green_blue(t[0], t[1], t[2]);
}

/// For looks that do not come from `image_of`.
cv::Vec3b colour_at(const Tile& tile, const std::vector<Range>& ranges, int x, int y) {
  const Plane& plane = *tile.plane;
  const double t = ranges[0].position(value_at(plane, tile.look, 0, x, y));
  switch (tile.look) {
    case Look::depth:
      return depth_colours()[to_byte(1 - t)];
    case Look::count:
      return count_colours()[to_byte(0.1 + 0.9 * t)];
    case Look::identity:
      return identity_colour(plane.channels[0].at(x, y));
    case Look::position:
      return position_colour(plane, ranges, x, y);
    case Look::motion:
      return motion_colour(plane.channels[0].at(x, y), plane.channels[1].at(x, y), ranges[0]);
    default:
      return grey(t);
  }
}

bool is_finite(const Tile& tile, int x, int y) {
  if (tile.look == Look::depth) {  // and so has a logarithm
    const float depth = tile.plane->channels[0].at(x, y);
    return depth > 0 && std::isfinite(depth);
  }
  for (size_t c = 0; c < components_of(*tile.plane, tile.look); ++c)
    if (!std::isfinite(value_at(*tile.plane, tile.look, c, x, y))) return false;
  return true;
}

bool comes_from_image_of(Look look) { return look == Look::direction || look == Look::colour || look == Look::share; }

}  // namespace

cv::Mat colours_of(const Tile& tile, const std::vector<Range>& scale) {
  cv::Mat image(tile.layout().height, tile.layout().width, CV_8UC3);
  const bool ready = comes_from_image_of(tile.look);
  if (ready) image = coloured(*tile.plane);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      if (tile.is_background(x, y)) continue;  // drawn as background
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      if (!is_finite(tile, x, y))
        pixel = not_finite_colour;
      else if (!ready)
        pixel = colour_at(tile, scale, x, y);
    }
  return image;
}

cv::Mat background_mask(const Tile& tile) {
  cv::Mat mask(tile.layout().height, tile.layout().width, CV_8UC1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) mask.at<unsigned char>(y, x) = tile.is_background(x, y) ? 255 : 0;
  return mask;
}

Sampling sampling_of(const Tile& tile) { return tile.look == Look::identity ? Sampling::point : Sampling::average; }

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// Words

std::string figure(double v) { return fmt::format("{:.3g}", v == 0 ? 0.0 : v); }  // no "-0"

std::string span(double low, double high) {
  return low == high ? figure(low) + " everywhere" : figure(low) + " .. " + figure(high);
}

size_t different_values(const std::vector<const Tile*>& tiles) {
  std::unordered_set<uint32_t> values;
  for (const Tile* tile : tiles)
    for (int y = 0; y < tile->layout().height; ++y)
      for (int x = 0; x < tile->layout().width; ++x)
        if (!tile->is_background(x, y)) values.insert(std::bit_cast<uint32_t>(tile->plane->channels[0].at(x, y)));
  return values.size();
}

/// All components in one.
Range united(const std::vector<Range>& ranges) {
  Range all = ranges.front();
  for (const Range& range : ranges) {
    if (range.finite == 0) continue;
    all.low = all.finite == 0 ? range.low : std::min(all.low, range.low);
    all.high = all.finite == 0 ? range.high : std::max(all.high, range.high);
    all.finite = std::max(all.finite, range.finite);
  }
  return all;
}

long long pixels_not_finite(const std::vector<const Tile*>& tiles) {
  long long count = 0;
  for (const Tile* tile : tiles)
    for (int y = 0; y < tile->layout().height; ++y)
      for (int x = 0; x < tile->layout().width; ++x) count += !tile->is_background(x, y) && !is_finite(*tile, x, y);
  return count;
}

Wordings axes(const std::vector<Range>& r) {
  const auto axis = [&](size_t c) { return fmt::format("{} {} .. {}", "xyz"[c], figure(r[c].low), figure(r[c].high)); };
  const auto extent = [&](size_t c) { return figure(r[c].high - r[c].low); };
  return {fmt::format("{}, {}, {}", axis(0), axis(1), axis(2)),
          fmt::format("{} x {} x {} across", extent(0), extent(1), extent(2))};
}

std::string instances(size_t count) { return fmt::format("{} instance{}", count, count == 1 ? "" : "s"); }

/// The range, and where it leaves the scale.
Wordings scalar_range(const Range& all, const Range& drawn) {
  const std::string text = span(all.low, all.high);
  if (drawn.first <= all.low && drawn.last >= all.high) return {text};
  return {fmt::format("{}, drawn {} .. {}", text, figure(drawn.first), figure(drawn.last)), text};
}

/// What the values of the tiles are.
Wordings values_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                         const std::vector<Range>& scale) {
  const Range all = united(own);
  switch (tiles.front()->look) {
    case Look::depth:
      return {span(std::exp(all.low), std::exp(all.high))};
    case Look::direction:
      return {"x, y, z as red, green, blue", "unit vectors"};
    case Look::identity:
      return {instances(different_values(tiles))};
    case Look::position:
      return axes(own);
    case Look::motion:
      return {fmt::format("hue: direction; longest {} pixels", figure(all.high)),
              fmt::format("longest {} pixels", figure(all.high))};
    case Look::scalar:
      return scalar_range(all, scale.front());
    default:
      return {span(all.low, all.high)};
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// The heading

/// Round numbers on a logarithmic scale: 1, 2 and 5 of each decade, or all digits where these are less than three.
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

/// Ticks with labels below the bar, as far as there is room.
void draw_depth_ticks(cv::Mat& canvas, int x0, int x1, int y, const Range& range, double unit) {
  const auto px = [&](double length) { return cvRound(length * unit); };
  const Style style{8.5 * unit};
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

/// "depth 1.2 [bar] 14", its left top corner at `at`, as wide as `width` at most: one scale for all depths of the sheet.
void draw_depth_scale(cv::Mat& canvas, const Range& depths, cv::Point at, int width, double unit) {
  const auto px = [&](double length) { return cvRound(length * unit); };
  const Style style{8.5 * unit};
  const int y0 = at.y, y1 = y0 + px(11), baseline = y1 - px(1);
  const std::string low = "depth  " + figure(std::exp(depths.first)), high = figure(std::exp(depths.last));
  put_text(canvas, low, {at.x, baseline}, style);
  const int x0 = at.x + cvRound(text_width(low, style)) + px(8);
  const int room = at.x + width - x0 - cvRound(text_width(high, style)) - px(8);
  const int x1 = x0 + std::clamp(room, px(16), px(340));
  for (int x = x0; x < x1; ++x) {
    const double t = double(x - x0) / (x1 - x0 - 1);
    cv::line(canvas, {x, y0}, {x, y1 - 1}, cv::Scalar(depth_colours()[to_byte(1 - t)]), 1);
  }
  cv::rectangle(canvas, {x0 - 1, y0 - 1}, {x1, y1}, rule, 1);
  put_text(canvas, high, {x1 + px(8), baseline}, style);
  draw_depth_ticks(canvas, x0, x1, y1 + 1, depths, unit);
}

}  // namespace

Wordings range_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                        const std::vector<Range>& scale) {
  const long long not_finite = pixels_not_finite(tiles);
  if (united(own).finite == 0) return {not_finite == 0 ? "no surface" : "nothing finite"};
  Wordings wordings = values_in_words(tiles, own, scale);
  for (std::string& wording : wordings)
    if (not_finite > 0) wording += fmt::format(", {} not finite", not_finite);
  return wordings;
}

std::string fitting(const Wordings& wordings, double width, const Style& style) {
  const auto fits = [&](const std::string& wording) { return text_width(wording, style) <= width; };
  return shortened(*std::find_if(wordings.begin(), wordings.end() - 1, fits), width, style);
}

int heading_height(double unit, bool has_depths) { return cvRound((has_depths ? 108 : 70) * unit); }

void draw_heading(cv::Mat& canvas, const Heading& heading) {
  const auto px = [&](double length) { return cvRound(length * heading.unit); };
  const Style title{14 * heading.unit, ink, true}, small{8.5 * heading.unit, faint};
  const int left = heading.margin, room = canvas.cols - 2 * left;
  put_text(canvas, shortened(heading.title, room, title), {left, px(36)}, title);
  put_text(canvas, fitting(heading.facts, room, small), {left, px(57)}, small);
  if (heading.depths) draw_depth_scale(canvas, *heading.depths, {left, px(72)}, room, heading.unit);
}

}  // namespace gloam
