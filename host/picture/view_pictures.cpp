#include "gloam/view_pictures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/colours.h"
#include "picture/heading.h"
#include "picture/picture.h"
#include "picture/scale.h"
#include "picture/tile.h"
#include "picture/wordings.h"

namespace gloam {
namespace {

constexpr int widest = 2400, margin = 24;

double unit_of(int width, double at_one) { return std::clamp(width / at_one, 0.8, 1.9); }

std::string counted(size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void check(const Frame& frame, const std::string& name, const std::string& path) {
  if (frame.width() < 1 || frame.height() < 1 || frame.views.empty())
    throw Error("{}: the frame has no pixels to draw", path);
  const Layout layout(frame.width(), frame.height());
  for (const View& view : frame.views) {
    const Plane* plane = view.find(name);
    if (!plane || plane->channels.empty()) throw Error("{}: view '{}' has no '{}' to draw", path, view.name, name);
    for (const Channel& channel : plane->channels)
      if (!(channel.layout() == layout))
        throw Error("{}: '{}' is {}x{} and the frame {}x{}; only planes of the frame's size are drawn", path, name,
                    channel.layout().width, channel.layout().height, frame.width(), frame.height());
    if (plane->channels.size() != frame.views[0].find(name)->channels.size())
      throw Error("{}: '{}' has {} in view '{}' and {} in view '{}'; views are drawn together where they have the same",
                  path, name, counted(frame.views[0].find(name)->channels.size(), "component"), frame.views[0].name,
                  counted(plane->channels.size(), "component"), view.name);
  }
}

std::vector<const Tile*> pointers(const std::vector<Tile>& tiles) {
  std::vector<const Tile*> list;
  for (const Tile& tile : tiles) list.push_back(&tile);
  return list;
}

bool any_background(const Tile& tile) {
  for (int y = 0; y < tile.layout().height; ++y)
    for (int x = 0; x < tile.layout().width; ++x)
      if (tile.is_background(x, y)) return true;
  return false;
}

/// Notes besides the range that a reader needs to understand the picture.
std::string key_in_words(const std::vector<Tile>& tiles) {
  std::string words;
  if (std::any_of(tiles.begin(), tiles.end(), any_background)) words += "; hatched: no surface";
  if (tiles.front().style == PictureStyle::depth) words += "; lengths in scene units";
  return words;
}

// ---------------------------------------------------------------------------------------------------------------------
// The sheet of views

/// Layout of the tiles.
struct Grid {
  static constexpr int gap = 12;
  PanelSize panel;
  double unit = 1, heading_unit = 1;
  int columns = 1, rows = 1, heading = 0;

  int caption() const { return cvRound(19 * unit); }
  int left(int column) const { return margin + column * (panel.box + gap); }
  int top(int row) const { return heading + row * (caption() + panel.image.height + gap) + caption(); }
  int width() const { return left(columns) - gap + margin; }
  int height() const { return top(rows) - caption() - gap + margin; }
  TextStyle label() const { return {9 * unit, ink}; }
};

/// Narrower tiles show nothing and cut off names.
constexpr int narrowest_tile = 96;

/// Number of columns that makes the sheet about half as wide again as high.
int columns_for(size_t views, double aspect) {
  const int most = (widest - 2 * margin + Grid::gap) / (narrowest_tile + Grid::gap);
  const int wanted = cvCeil(std::sqrt(1.5 * double(views) / std::clamp(aspect, 0.5, 4.0)));
  return std::clamp(std::min(wanted, int(views)), 1, most);
}

/// Images are not enlarged, except small ones.
Grid grid_for(const Frame& frame, bool has_depths) {
  Grid grid;
  grid.columns = columns_for(frame.views.size(), double(frame.width()) / frame.height());
  grid.rows = (int(frame.views.size()) + grid.columns - 1) / grid.columns;
  const int room = (widest - 2 * margin + Grid::gap) / grid.columns - Grid::gap;
  const int tile = std::min(room, std::max(frame.width(), 480));
  grid.panel = panel_size(frame.width(), frame.height(), {tile, tile, 2 * tile});
  grid.unit = std::clamp(tile / 220.0, 0.8, 1.2);
  grid.heading_unit = unit_of(grid.width(), 1200);
  grid.heading = heading_height(grid.heading_unit, has_depths);
  return grid;
}

/// Draws the tiles in parallel: a view takes long, and tiles do not overlap.
void draw_tiles(cv::Mat& canvas, const Grid& grid, const std::vector<Tile>& tiles, const std::vector<Range>& scale) {
  cv::parallel_for_(cv::Range(0, int(tiles.size())), [&](const cv::Range& part) {
    for (int i = part.start; i < part.end; ++i) {
      const Tile& tile = tiles[size_t(i)];
      const cv::Point corner(grid.left(i % grid.columns), grid.top(i / grid.columns));
      put_panel(canvas, colours_of(tile, scale), background_mask(tile), corner, grid.panel.image, grid.unit,
                sampling_of(tile));
    }
  });
}

void draw_labels(cv::Mat& canvas, const Grid& grid, const std::vector<Tile>& tiles) {
  for (int i = 0; i < int(tiles.size()); ++i) {
    const cv::Point at(grid.left(i % grid.columns), grid.top(i / grid.columns) - cvRound(6 * grid.unit));
    put_text(canvas, shortened(tiles[size_t(i)].view->name, grid.panel.box, grid.label()), at, grid.label());
  }
}

Wordings facts_of(const Frame& frame, const std::vector<Tile>& tiles, const std::vector<Range>& scale,
                  const std::string& zoom_note) {
  const std::string zoom = zoom_note.empty() ? "" : fmt::format(" ({})", zoom_note);
  const std::string size = fmt::format("{} x {} pixels{}", frame.width(), frame.height(), zoom);
  const std::string views = counted(tiles.size(), "view"), scale_note = tiles.size() > 1 ? ", all on one scale" : "";
  Wordings wordings;
  for (const std::string& range : range_in_words(pointers(tiles), scale, scale)) {
    wordings.push_back(fmt::format("{} of {}{}; {}{}", views, size, scale_note, range, key_in_words(tiles)));
    wordings.push_back(fmt::format("{} of {}; {}{}", views, size, range, key_in_words(tiles)));
    wordings.push_back(fmt::format("{} of {}; {}", views, size, range));
  }
  wordings.push_back(views);
  return wordings;
}

// ---------------------------------------------------------------------------------------------------------------------
// Scan lines

/// Row `y` of a plane of each view, one below the other.
Plane stacked_rows(const Frame& frame, const std::string& name, int y) {
  Plane stack{name, {}};
  const int views = int(frame.views.size());
  for (size_t c = 0; c < frame.views[0].find(name)->channels.size(); ++c) {
    Channel channel(Layout(frame.width(), views), 0);
    for (int i = 0; i < views; ++i) {
      const float* row = frame.views[size_t(i)].find(name)->channels[c].row(y);
      std::copy(row, row + frame.width(), channel.row(i));
    }
    stack.channels.push_back(std::move(channel));
  }
  return stack;
}

/// The scan lines as a view with one row per view; with depth, to recognise background, if all views have it.
View stacked_view(const Frame& frame, const std::string& plane, int y) {
  View stack;
  stack.planes[plane] = stacked_rows(frame, plane, y);
  const Layout layout(frame.width(), frame.height());
  const bool has_depth = std::all_of(frame.views.begin(), frame.views.end(), [&](const View& view) {
    const Plane* depth = view.find("depth");
    return depth && depth->channels.size() == 1 && depth->channels[0].layout() == layout;
  });
  if (has_depth && plane != "depth") stack.planes["depth"] = stacked_rows(frame, "depth", y);
  return stack;
}

/// Layout of the scan lines.
struct LinesLayout {
  PanelSize panel;
  double unit = 1;
  int lines = 1, line_height = 1, label_width = 0, heading = 0;

  int px(double length) const { return cvRound(length * unit); }
  int left() const { return margin + label_width + px(10); }
  int top() const { return heading; }
  int height_of_lines() const { return lines * line_height; }
  int width() const { return left() + panel.image.width + margin; }
  int height() const { return top() + height_of_lines() + px(30) + margin; }
  TextStyle label() const { return {8.5 * unit, ink}; }
};

LinesLayout lines_layout(const Frame& frame, bool has_depths) {
  LinesLayout layout;
  constexpr int thinnest = 320, most_for_labels = 240;
  layout.panel =
      panel_size(frame.width(), frame.width(), {960, widest - 2 * margin - most_for_labels, frame.width() + widest});
  layout.unit = unit_of(layout.panel.image.width, 960);
  layout.lines = int(frame.views.size());
  layout.line_height = std::max(1, (thinnest + layout.lines - 1) / layout.lines);
  double longest = 0;
  for (const View& view : frame.views) longest = std::max(longest, text_width(drawable(view.name), layout.label()));
  layout.label_width = std::min(cvCeil(longest), most_for_labels - layout.px(10));
  layout.heading = heading_height(layout.unit, has_depths) + layout.px(6);
  return layout;
}

/// Draws as many view names as there is room for, always the first and the last.
void draw_view_names(cv::Mat& canvas, const LinesLayout& layout, const std::vector<View>& views) {
  const int room = layout.px(14), last = layout.lines - 1;
  const auto middle = [&](int line) { return layout.top() + line * layout.line_height + layout.line_height / 2; };
  int free_from = 0;
  for (int line = 0; line <= last; ++line) {
    if (line != last && (middle(line) < free_from || (line > 0 && middle(last) - middle(line) < room))) continue;
    free_from = middle(line) + room;
    const cv::Point at(layout.left() - layout.px(6), middle(line) + layout.px(4));
    put_text(canvas, shortened(views[size_t(line)].name, layout.label_width, layout.label()), at, layout.label(),
             Align::right);
  }
}

/// 1, 2 or 5 times a power of ten.
int round_step(double least) {
  int decade = 1;
  while (decade * 10 < least) decade *= 10;
  for (const int digit : {1, 2, 5})
    if (digit * decade >= least) return digit * decade;
  return 10 * decade;
}

/// Draws columns of the image as ticks, so that shifts from view to view can be read off. `first`: the column at the left end.
void draw_column_ticks(cv::Mat& canvas, const LinesLayout& layout, int columns, int first) {
  const double zoom = double(layout.panel.image.width) / columns;
  const int step = round_step(layout.px(70) / zoom), y = layout.top() + layout.height_of_lines() + 1;
  for (int column = 0; column < columns; ++column) {
    if ((column + first) % step != 0) continue;
    const int x = layout.left() + cvRound((column + 0.5) * zoom);
    cv::line(canvas, {x, y}, {x, y + layout.px(4)}, ink, 1);
    put_text(canvas, std::to_string(column + first), {x, y + layout.px(17)}, layout.label(), Align::centre);
  }
}

Wordings facts_of(const Frame& frame, const Tile& tile, const std::vector<Range>& scale, const std::string& zoom_note) {
  const std::vector<View>& views = frame.views;
  const std::string zoom = zoom_note.empty() ? "" : fmt::format(" ({})", zoom_note);
  const std::string count = counted(views.size(), "view"), key = key_in_words({tile});
  const std::string order = views.size() == 1 ? "" : fmt::format(", {} on top", views.front().name);
  Wordings wordings;
  for (const std::string& range : range_in_words({&tile}, scale, scale)) {
    wordings.push_back(fmt::format("{}{}; {} pixels wide{}; {}{}", count, order, frame.width(), zoom, range, key));
    wordings.push_back(fmt::format("{}{}; {}", count, order, range));
  }
  wordings.push_back(count);
  return wordings;
}

}  // namespace

void write_view_sheet(const std::filesystem::path& path, const Frame& frame, const ViewSheet& options) {
  check(frame, options.plane, path.string());
  std::vector<Tile> tiles;
  for (const View& view : frame.views) tiles.push_back(tile_of(view, *view.find(options.plane)));
  const Scales scales = scales_of(tiles);
  const std::vector<Range>& scale = scales.begin()->second;
  const Range* depths = depth_scale(scales);
  const Grid grid = grid_for(frame, depths);
  cv::Mat canvas(grid.height(), grid.width(), CV_8UC3, paper);
  draw_heading(canvas, {fmt::format("{}: {}", options.title, options.plane),
                        facts_of(frame, tiles, scale, grid.panel.zoom_note), depths, grid.heading_unit, margin});
  draw_tiles(canvas, grid, tiles, scale);
  draw_labels(canvas, grid, tiles);
  write_png(path, canvas);
}

void write_scan_lines(const std::filesystem::path& path, const Frame& frame, const ScanLines& options) {
  check(frame, options.plane, path.string());
  if (options.row < 0 || options.row >= frame.display.height())
    throw Error("{}: row {} is not drawn; the image has rows 0 to {}", path.string(), options.row,
                frame.display.height() - 1);
  const View stack = stacked_view(frame, options.plane, options.row + frame.display.y0 - frame.window.y0);
  const Tile tile = tile_of(stack, *stack.find(options.plane));
  const Scales scales = scales_of({tile});
  const std::vector<Range>& scale = scales.begin()->second;
  const Range* depths = depth_scale(scales);
  const LinesLayout layout = lines_layout(frame, depths);
  cv::Mat canvas(layout.height(), layout.width(), CV_8UC3, paper);
  draw_heading(canvas, {fmt::format("{}: {}, row {}", options.title, options.plane, options.row),
                        facts_of(frame, tile, scale, layout.panel.zoom_note), depths, layout.unit, margin});
  put_panel(canvas, colours_of(tile, scale), background_mask(tile), {layout.left(), layout.top()},
            {layout.panel.image.width, layout.height_of_lines()}, layout.unit, sampling_of(tile));
  draw_view_names(canvas, layout, frame.views);
  draw_column_ticks(canvas, layout, frame.width(), frame.window.x0 - frame.display.x0);
  write_png(path, canvas);
}

}  // namespace gloam
