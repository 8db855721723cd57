#include "gloam/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <optional>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "picture/colours.h"
#include "picture/heading.h"
#include "picture/picture.h"
#include "picture/scale.h"
#include "picture/tile.h"
#include "picture/wordings.h"

namespace gloam {
namespace {

// ---------------------------------------------------------------------------------------------------------------------
// Which tiles

/// Rank of a plane on the sheet: kinds in the order of their table, then stacks, then unknown planes.
std::pair<size_t, std::string> rank_of(const std::string& name) {
  const std::vector<PlaneKind>& kinds = plane_kinds();
  size_t i = 0;
  while (i < kinds.size() && kinds[i].name != name) ++i;
  return {i + (i == kinds.size() && !stack_layer(name)), name};
}

std::vector<const Plane*> planes_in_order(const View& view) {
  std::vector<const Plane*> planes;
  for (const auto& [name, plane] : view.planes) planes.push_back(&plane);
  std::sort(planes.begin(), planes.end(),
            [](const Plane* a, const Plane* b) { return rank_of(a->name) < rank_of(b->name); });
  return planes;
}

struct SheetTile : Tile {
  int layers_left_out = 0;  ///< layers of the stack after this tile, its last drawn layer
};

/// The tiles of a view. The first `layers` of each stack are drawn; the last of them gives the number of the others.
std::vector<SheetTile> tiles_of(const View& view, int layers) {
  std::vector<SheetTile> tiles;
  std::map<std::string, int> drawn;
  for (const Plane* plane : planes_in_order(view)) {
    const std::optional<StackLayer> layer = stack_layer(plane->name);
    if (layer && layers > 0 && ++drawn[layer->stack] > layers) {
      ++tiles.back().layers_left_out;  // layers of a stack follow one another
      continue;
    }
    tiles.push_back({tile_of(view, *plane)});
  }
  return tiles;
}

// ---------------------------------------------------------------------------------------------------------------------
// The sheet

struct Sheet {
  cv::Mat canvas;
  double unit = 1;
  PanelSize panel;
  int columns = 1, rows = 0;
  bool has_depth = false;  ///< the header has a scale of depths

  int px(double length) const { return cvRound(length * unit); }
  int margin() const { return px(24); }
  int gap() const { return px(18); }
  int caption() const { return px(38); }
  int header() const { return heading_height(unit, has_depth); }
  int left(int column) const { return margin() + column * (panel.box + gap()); }
  int top(int row) const { return header() + row * (caption() + panel.image.height + gap()) + caption(); }
  int width() const { return left(columns) - gap() + margin(); }
  int height() const { return top(rows) - caption() - gap() + margin(); }
  TextStyle strong() const { return {9.5 * unit, ink, true}; }
  TextStyle small() const { return {8.5 * unit, faint}; }
};

/// Up to four columns, as many as rows before.
int fitting_columns(size_t most_tiles) { return std::clamp(cvCeil(std::sqrt(double(most_tiles))), 1, 4); }

void draw_header(Sheet& sheet, const Frame& frame, size_t tiles, const std::string& title, const Range* depths) {
  const std::string zoom = sheet.panel.zoom_note.empty() ? "" : fmt::format(" ({})", sheet.panel.zoom_note);
  const std::string facts = fmt::format("{} x {} pixels{}, {} tile{}; hatched: no surface; lengths in scene units",
                                        frame.width(), frame.height(), zoom, tiles, tiles == 1 ? "" : "s");
  draw_heading(sheet.canvas, {title, {facts}, depths, sheet.unit, sheet.margin()});
}

/// The name, and below it the range.
void draw_caption(Sheet& sheet, const SheetTile& tile, cv::Point corner, const Wordings& range) {
  const std::string view = tile.view->name.empty() ? "" : tile.view->name + ": ";
  const std::string more = tile.layers_left_out > 0 ? fmt::format("and {} more", tile.layers_left_out) : "";
  const double taken = more.empty() ? 0 : text_width(more, sheet.small()) + sheet.px(8);
  const std::string name = shortened(view + tile.plane->name, sheet.panel.box - taken, sheet.strong());
  put_text(sheet.canvas, name, corner - cv::Point(0, sheet.px(23)), sheet.strong());
  const int after = cvRound(text_width(name, sheet.strong())) + sheet.px(8);
  put_text(sheet.canvas, more, corner + cv::Point(after, -sheet.px(23)), sheet.small());
  put_text(sheet.canvas, fitting(range, sheet.panel.box, sheet.small()), corner - cv::Point(0, sheet.px(8)),
           sheet.small());
}

void draw_tile(Sheet& sheet, const SheetTile& tile, const Scales& scales, int column, int row) {
  const std::vector<Range>& scale = scales.at(scale_key(tile));
  const cv::Point corner(sheet.left(column), sheet.top(row));
  draw_caption(sheet, tile, corner, range_in_words({&tile}, ranges_of({&tile}), scale));
  put_panel(sheet.canvas, colours_of(tile, scale), background_mask(tile), corner, sheet.panel.image, sheet.unit,
            sampling_of(tile));
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
          throw Error("{}: '{}' is {}x{} and the frame {}x{}; only planes of the frame's size are drawn", path, name,
                      channel.layout().width, channel.layout().height, frame.width(), frame.height());
      if (plane.channels.empty()) throw Error("{}: '{}' has no component to draw", path, name);
      ++planes;
    }
  if (planes == 0) throw Error("{}: the frame has no plane to draw", path);
}

Sheet blank_sheet(const Frame& frame, const ContactSheet& options, const std::vector<std::vector<SheetTile>>& views) {
  Sheet sheet;
  const int tile = options.tile_width;
  sheet.panel = panel_size(frame.width(), frame.height(), {tile, tile, 2 * tile});
  sheet.unit = std::clamp(tile / 480.0, 0.8, 1.9);
  size_t most = 0;
  for (const std::vector<SheetTile>& tiles : views) most = std::max(most, tiles.size());
  sheet.columns = options.columns > 0 ? options.columns : fitting_columns(most);
  sheet.columns = std::min(sheet.columns, int(most));
  for (const std::vector<SheetTile>& tiles : views) {
    sheet.rows += (int(tiles.size()) + sheet.columns - 1) / sheet.columns;
    for (const SheetTile& t : tiles) sheet.has_depth |= t.style == PictureStyle::depth;
  }
  sheet.canvas = cv::Mat(sheet.height(), sheet.width(), CV_8UC3, paper);
  return sheet;
}

/// Rounds colours to multiples of `step`; white stays white.
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
  std::vector<std::vector<SheetTile>> views;
  std::vector<Tile> all;
  for (const View& view : frame.views) {
    views.push_back(tiles_of(view, options.layers));
    all.insert(all.end(), views.back().begin(), views.back().end());
  }
  Sheet sheet = blank_sheet(frame, options, views);
  const Scales scales = scales_of(all);
  draw_header(sheet, frame, all.size(), options.title, depth_scale(scales));
  int row = 0;
  for (const std::vector<SheetTile>& tiles : views) {
    for (size_t i = 0; i < tiles.size(); ++i)
      draw_tile(sheet, tiles[i], scales, int(i) % sheet.columns, row + int(i) / sheet.columns);
    row += (int(tiles.size()) + sheet.columns - 1) / sheet.columns;
  }
  round_colours(sheet.canvas, options.colour_step);
  write_png(path, sheet.canvas);
}

}  // namespace gloam
