// The contact sheet: every plane of a frame as a tile, coloured by what its values mean.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <unordered_set>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"
#include "picture.h"

namespace gloam {
namespace {

// ---------------------------------------------------------------------------------------------------------------------
// What planes mean

/// How a plane is coloured.
enum class Look {
  depth,      ///< logarithmic scale that all depths of the sheet share; near is bright
  direction,  ///< 0.5 + 0.5 n as red, green, blue
  colour,     ///< through sRGB
  share,      ///< grey, 0 to 1
  identity,   ///< a colour of its own for each value
  count,      ///< colour map from the least to the most
  position,   ///< each axis scaled to its range, as red, green, blue
  motion,     ///< hue by direction, brightness by length
  scalar,     ///< grey, scaled to its range
};

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

// ---------------------------------------------------------------------------------------------------------------------
// One plane of one view

struct Tile {
  const View* view;
  const Plane* plane;
  Look look;
  const Channel* background = nullptr;  ///< depth that is infinite where the tile is hatched; none: nowhere
  int layers_left_out = 0;              ///< of the stack that this tile is the last drawn layer of

  const Layout& layout() const { return plane->channels[0].layout(); }
  bool is_background(int x, int y) const { return background && gloam::is_background(background->at(x, y)); }
};

const Channel* background_of(const View& view, const Plane& plane, Look look) {
  if (look == Look::depth) return &plane.channels[0];
  const Plane* depth = view.find("depth");
  return depth && !depth->channels.empty() && !background_has_value(plane) ? &depth->channels[0] : nullptr;
}

/// Where a plane stands on the sheet: kinds in the order of their table, then stacks, then what gloam does not know.
std::pair<size_t, std::string> place_of(const std::string& name) {
  const std::vector<PlaneKind>& kinds = plane_kinds();
  size_t i = 0;
  while (i < kinds.size() && kinds[i].name != name) ++i;
  return {i + (i == kinds.size() && !stack_layer(name)), name};
}

std::vector<const Plane*> planes_in_order(const View& view) {
  std::vector<const Plane*> planes;
  for (const auto& [name, plane] : view.planes) planes.push_back(&plane);
  std::sort(planes.begin(), planes.end(),
            [](const Plane* a, const Plane* b) { return place_of(a->name) < place_of(b->name); });
  return planes;
}

/// The tiles of a view. Of each stack the first `layers` are drawn; the last of them says how many are not.
std::vector<Tile> tiles_of(const View& view, int layers) {
  std::vector<Tile> tiles;
  std::map<std::string, int> drawn;
  for (const Plane* plane : planes_in_order(view)) {
    const std::optional<StackLayer> layer = stack_layer(plane->name);
    if (layer && layers > 0 && ++drawn[layer->stack] > layers) {
      ++tiles.back().layers_left_out;  // layers of a stack follow one another
      continue;
    }
    const Look look = look_of(*plane);
    tiles.push_back({&view, plane, look, background_of(view, *plane, look)});
  }
  return tiles;
}

// ---------------------------------------------------------------------------------------------------------------------
// Ranges

/// Of the values that are drawn of one component.
struct Range {
  double low = 0, high = 0;    ///< of all finite values
  double first = 0, last = 0;  ///< ends of the colours
  long long finite = 0;        ///< pixels

  double position(double v) const { return last > first ? std::clamp((v - first) / (last - first), 0.0, 1.0) : 0.5; }
};

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

/// Over the tiles that are drawn on one scale.
Range range_of(const std::vector<const Tile*>& tiles, size_t component) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<float> sample;
  size_t pixels = 0, seen = 0;
  for (const Tile* tile : tiles) pixels += size_t(tile->layout().width) * size_t(tile->layout().height);
  const size_t step = 1 + pixels / sample_size;
  for (const Tile* tile : tiles)
    for (int y = 0; y < tile->layout().height; ++y)
      for (int x = 0; x < tile->layout().width; ++x) {
        if (tile->is_background(x, y)) continue;
        const double v = value_at(*tile->plane, tile->look, component, x, y);
        if (!std::isfinite(v)) continue;
        range.low = std::min(range.low, v);
        range.high = std::max(range.high, v);
        ++range.finite;
        if (seen++ % step == 0) sample.push_back(float(v));
      }
  if (range.finite == 0) range.low = range.high = 0;
  choose_ends(range, sample, tiles.front()->look);
  return range;
}

std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles) {
  std::vector<Range> ranges;
  const Tile& first = *tiles.front();
  for (size_t c = 0; c < components_of(*first.plane, first.look); ++c) ranges.push_back(range_of(tiles, c));
  return ranges;
}

/// Tiles of one key share a scale: all depths, and one plane in several views.
const std::string depth_key = "all depths";
std::string scale_key(const Tile& tile) {
  return tile.look == Look::depth ? depth_key : fmt::format("{} {}", tile.plane->name, tile.plane->channels.size());
}

using Scales = std::map<std::string, std::vector<Range>>;

Scales scales_of(const std::vector<Tile>& tiles) {
  std::map<std::string, std::vector<const Tile*>> alike;
  for (const Tile& tile : tiles) alike[scale_key(tile)].push_back(&tile);
  Scales scales;
  for (const auto& [key, group] : alike) scales[key] = ranges_of(group);
  return scales;
}

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
  for (size_t c = 0; c < components_of(*tile.plane, tile.look); ++c)
    if (!std::isfinite(value_at(*tile.plane, tile.look, c, x, y))) return false;
  return true;
}

bool comes_from_image_of(Look look) { return look == Look::direction || look == Look::colour || look == Look::share; }

/// The plane at full size.
cv::Mat colours_of(const Tile& tile, const std::vector<Range>& ranges) {
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
        pixel = colour_at(tile, ranges, x, y);
    }
  return image;
}

cv::Mat background_mask(const Tile& tile) {
  cv::Mat mask(tile.layout().height, tile.layout().width, CV_8UC1);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) mask.at<unsigned char>(y, x) = tile.is_background(x, y) ? 255 : 0;
  return mask;
}

// ---------------------------------------------------------------------------------------------------------------------
// Words

std::string figure(double v) { return fmt::format("{:.3g}", v == 0 ? 0.0 : v); }  // no "-0"

std::string span(double low, double high) {
  return low == high ? figure(low) + " everywhere" : figure(low) + " .. " + figure(high);
}

size_t different_values(const Tile& tile) {
  std::unordered_set<uint32_t> values;
  for (int y = 0; y < tile.layout().height; ++y)
    for (int x = 0; x < tile.layout().width; ++x)
      if (!tile.is_background(x, y)) values.insert(std::bit_cast<uint32_t>(tile.plane->channels[0].at(x, y)));
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

long long pixels_not_finite(const Tile& tile) {
  long long count = 0;
  for (int y = 0; y < tile.layout().height; ++y)
    for (int x = 0; x < tile.layout().width; ++x) count += !tile.is_background(x, y) && !is_finite(tile, x, y);
  return count;
}

/// Several ways to say it, the longest first.
using Wordings = std::vector<std::string>;

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

/// What the values of a tile are.
Wordings values_in_words(const Tile& tile, const std::vector<Range>& own, const std::vector<Range>& scale) {
  const Range all = united(own);
  switch (tile.look) {
    case Look::depth:
      return {span(std::exp(all.low), std::exp(all.high))};
    case Look::direction:
      return {"x, y, z as red, green, blue", "unit vectors"};
    case Look::identity:
      return {instances(different_values(tile))};
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

Wordings range_in_words(const Tile& tile, const std::vector<Range>& own, const std::vector<Range>& scale) {
  const long long not_finite = pixels_not_finite(tile);
  if (united(own).finite == 0) return {not_finite == 0 ? "no surface" : "nothing finite"};
  Wordings wordings = values_in_words(tile, own, scale);
  for (std::string& wording : wordings)
    if (not_finite > 0) wording += fmt::format(", {} not finite", not_finite);
  return wordings;
}

// ---------------------------------------------------------------------------------------------------------------------
// The sheet

struct Sheet {
  cv::Mat canvas;
  double unit = 1;
  PanelSize panel;
  int columns = 1, rows = 0;
  bool has_depth = false;  ///< a scale of depths stands in the header

  int px(double length) const { return cvRound(length * unit); }
  int margin() const { return px(24); }
  int gap() const { return px(18); }
  int caption() const { return px(38); }
  int header() const { return px(has_depth ? 108 : 70); }
  int left(int column) const { return margin() + column * (panel.box + gap()); }
  int top(int row) const { return header() + row * (caption() + panel.image.height + gap()) + caption(); }
  int width() const { return left(columns) - gap() + margin(); }
  int height() const { return top(rows) - caption() - gap() + margin(); }
  Style title() const { return {14 * unit, ink, true}; }
  Style strong() const { return {9.5 * unit, ink, true}; }
  Style small() const { return {8.5 * unit, faint}; }
  Style tick() const { return {8.5 * unit, ink}; }
};

/// Up to four columns, as many as rows before.
int fitting_columns(size_t most_tiles) { return std::clamp(cvCeil(std::sqrt(double(most_tiles))), 1, 4); }

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
void draw_depth_ticks(Sheet& sheet, int x0, int x1, int y, const Range& range) {
  const int space = sheet.px(8);
  int used = x0 - space;
  for (const double depth : round_depths(std::exp(range.first), std::exp(range.last))) {
    const int x = x0 + cvRound((x1 - x0) * range.position(std::log(depth)));
    const std::string label = fmt::format("{:g}", depth);
    const int half = cvCeil(text_width(label, sheet.tick()) / 2);
    if (x - half < used + space || x + half > x1) continue;
    cv::line(sheet.canvas, {x, y}, {x, y + sheet.px(3)}, ink, 1);
    put_text(sheet.canvas, label, {x, y + sheet.px(15)}, sheet.tick(), Align::centre);
    used = x + half;
  }
}

/// "depth 1.2 [bar] 14": one scale for all depths of the sheet.
void draw_depth_scale(Sheet& sheet, const Range& range) {
  const int y0 = sheet.px(72), y1 = y0 + sheet.px(11), baseline = y1 - sheet.px(1);
  const std::string low = "depth  " + figure(std::exp(range.first)), high = figure(std::exp(range.last));
  put_text(sheet.canvas, low, {sheet.margin(), baseline}, sheet.tick());
  const int x0 = sheet.margin() + cvRound(text_width(low, sheet.tick())) + sheet.px(8);
  const int room = sheet.width() - sheet.margin() - x0 - cvRound(text_width(high, sheet.tick())) - sheet.px(8);
  const int x1 = x0 + std::clamp(room, sheet.px(16), sheet.px(340));
  for (int x = x0; x < x1; ++x) {
    const double t = double(x - x0) / (x1 - x0 - 1);
    cv::line(sheet.canvas, {x, y0}, {x, y1 - 1}, cv::Scalar(depth_colours()[to_byte(1 - t)]), 1);
  }
  cv::rectangle(sheet.canvas, {x0 - 1, y0 - 1}, {x1, y1}, rule, 1);
  put_text(sheet.canvas, high, {x1 + sheet.px(8), baseline}, sheet.tick());
  draw_depth_ticks(sheet, x0, x1, y1 + 1, range);
}

void draw_header(Sheet& sheet, const Frame& frame, size_t tiles, const std::string& title) {
  const double room = sheet.width() - 2 * sheet.margin();
  put_text(sheet.canvas, shortened(title, room, sheet.title()), {sheet.margin(), sheet.px(36)}, sheet.title());
  const std::string zoom = sheet.panel.zoom_note.empty() ? "" : fmt::format(" ({})", sheet.panel.zoom_note);
  const std::string facts = fmt::format("{} x {} pixels{}, {} tile{}; hatched: no surface; lengths in scene units",
                                        frame.width(), frame.height(), zoom, tiles, tiles == 1 ? "" : "s");
  put_text(sheet.canvas, shortened(facts, room, sheet.small()), {sheet.margin(), sheet.px(57)}, sheet.small());
}

/// The name, and below it the range.
void draw_caption(Sheet& sheet, const Tile& tile, cv::Point corner, const Wordings& range) {
  const std::string view = tile.view->name.empty() ? "" : tile.view->name + ": ";
  const std::string more = tile.layers_left_out > 0 ? fmt::format("and {} more", tile.layers_left_out) : "";
  const double taken = more.empty() ? 0 : text_width(more, sheet.small()) + sheet.px(8);
  const std::string name = shortened(view + tile.plane->name, sheet.panel.box - taken, sheet.strong());
  put_text(sheet.canvas, name, corner - cv::Point(0, sheet.px(23)), sheet.strong());
  const int after = cvRound(text_width(name, sheet.strong())) + sheet.px(8);
  put_text(sheet.canvas, more, corner + cv::Point(after, -sheet.px(23)), sheet.small());
  const auto fits = [&](const std::string& wording) { return text_width(wording, sheet.small()) <= sheet.panel.box; };
  const auto chosen = std::find_if(range.begin(), range.end() - 1, fits);  // the last has to do
  put_text(sheet.canvas, shortened(*chosen, sheet.panel.box, sheet.small()), corner - cv::Point(0, sheet.px(8)),
           sheet.small());
}

void draw_tile(Sheet& sheet, const Tile& tile, const Scales& scales, int column, int row) {
  const std::vector<Range>& scale = scales.at(scale_key(tile));
  const cv::Point corner(sheet.left(column), sheet.top(row));
  draw_caption(sheet, tile, corner, range_in_words(tile, ranges_of({&tile}), scale));
  put_panel(sheet.canvas, colours_of(tile, scale), background_mask(tile), corner, sheet.panel.image, sheet.unit,
            tile.look == Look::identity ? Sampling::point : Sampling::average);
}

void check(const Frame& frame, const ContactSheet& options, const std::string& path) {
  if (options.tile_width < 64 || options.tile_width > 4096)
    throw Error("{}: a tile of {} pixels is not drawn; 64 to 4096 are allowed", path, options.tile_width);
  if (frame.width() < 1 || frame.height() < 1) throw Error("{}: the frame has no pixels to draw", path);
  size_t planes = 0;
  for (const View& view : frame.views)
    for (const auto& [name, plane] : view.planes) {
      for (const Channel& channel : plane.channels)
        if (!(channel.layout() == Layout(frame.width(), frame.height())))
          throw Error("{}: '{}' is {}x{} and the frame {}x{}: no picture of it", path, name, channel.layout().width,
                      channel.layout().height, frame.width(), frame.height());
      if (plane.channels.empty()) throw Error("{}: '{}' has no component to draw", path, name);
      ++planes;
    }
  if (planes == 0) throw Error("{}: the frame has no plane to draw", path);
}

Sheet blank_sheet(const Frame& frame, const ContactSheet& options, const std::vector<std::vector<Tile>>& views) {
  Sheet sheet;
  const int tile = options.tile_width;
  sheet.panel = panel_size(frame.width(), frame.height(), {tile, tile, 2 * tile});
  sheet.unit = std::clamp(tile / 480.0, 0.8, 1.9);
  size_t most = 0;
  for (const std::vector<Tile>& tiles : views) most = std::max(most, tiles.size());
  sheet.columns = options.columns > 0 ? options.columns : fitting_columns(most);
  sheet.columns = std::min(sheet.columns, int(most));
  for (const std::vector<Tile>& tiles : views) {
    sheet.rows += (int(tiles.size()) + sheet.columns - 1) / sheet.columns;
    for (const Tile& t : tiles) sheet.has_depth |= t.look == Look::depth;
  }
  sheet.canvas = cv::Mat(sheet.height(), sheet.width(), CV_8UC3, paper);
  return sheet;
}

/// To multiples of `step`; white stays white.
void round_colours(cv::Mat& canvas, int step) {
  if (step <= 1) return;
  cv::Mat table(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i)
    table.at<unsigned char>(0, i) = static_cast<unsigned char>(std::min(255, (i + step / 2) / step * step));
  cv::LUT(canvas, table, canvas);
}

}  // namespace

void write_contact_sheet(const std::filesystem::path& path, const Frame& frame, const ContactSheet& options) {
  check(frame, options, path.string());
  std::vector<std::vector<Tile>> views;
  std::vector<Tile> all;
  for (const View& view : frame.views) {
    views.push_back(tiles_of(view, options.layers));
    all.insert(all.end(), views.back().begin(), views.back().end());
  }
  Sheet sheet = blank_sheet(frame, options, views);
  draw_header(sheet, frame, all.size(), options.title);
  const Scales scales = scales_of(all);
  if (const auto depths = scales.find(depth_key); depths != scales.end())
    draw_depth_scale(sheet, depths->second.front());
  int row = 0;
  for (const std::vector<Tile>& tiles : views) {
    for (size_t i = 0; i < tiles.size(); ++i)
      draw_tile(sheet, tiles[i], scales, int(i) % sheet.columns, row + int(i) / sheet.columns);
    row += (int(tiles.size()) + sheet.columns - 1) / sheet.columns;
  }
  round_colours(sheet.canvas, options.colour_step);
  write_png(path, sheet.canvas);
}

}  // namespace gloam
