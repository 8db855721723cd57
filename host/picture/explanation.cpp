#include "gloam/explanation.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/explanation_panel.h"
#include "picture/picture.h"
#include "picture/table.h"
#include "picture/text_block.h"
#include "picture/wordings.h"

namespace gloam {
namespace {

// ---------------------------------------------------------------------------------------------------------------------
// Words

const TextStyle title_style{14, ink, true}, legend_style{10, ink}, caption_style{11, ink, true}, note_style{10, faint},
    cell_style{10.5, ink}, name_style{10.5, ink, true}, faint_cell{10.5, faint}, totals_style{11, ink, true};

/// The vermilion of Okabe and Ito (2008), which stands out from the tint. Blue, green, red.
const cv::Scalar outline_tone(0, 94, 213);

bool is_somewhere(const Explanation& e) { return !e.where.empty() && e.where != "-"; }

std::string share_of(const Explanation& e) {
  return is_somewhere(e) && !e.is_everywhere ? fmt::format(" on {} of the image", e.where) : "";
}

/// "ambient occlusion: on 34 % of the image"
std::string caption_of(const Explanation& e) {
  const bool is_computed = e.wanted == Explanation::Wanted::yes;
  if (e.is_everywhere) return e.effect + (is_computed ? ": everywhere" : ": called for, but left out");
  const std::string share = share_of(e);
  if (is_computed) return fmt::format("{}{}{}", e.effect, share.empty() ? "" : ":", share);
  return share.empty() ? e.effect + ": not called for" : fmt::format("{}: called for{}, but left out", e.effect, share);
}

bool has_panel(const Explanation& e) {
  return e.wanted == Explanation::Wanted::yes || (e.wanted == Explanation::Wanted::no && (e.cells || e.is_everywhere));
}

std::string in_words(Explanation::Wanted wanted) {
  return wanted == Explanation::Wanted::yes ? "yes" : wanted == Explanation::Wanted::no ? "no" : "not possible";
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

Table table_of(const std::vector<Explanation>& effects, int width) {
  Table table{{{"effect", Align::left, std::max(230, width * 2 / 9)},
               {"computed", Align::left, 120},
               {"where", Align::right, 130},
               {"why"},
               {"saved", Align::right, 170},
               {"lost", Align::right, std::max(150, width / 6)}},
              {}};
  for (const Explanation& e : effects) {
    const TextStyle& style = e.wanted == Explanation::Wanted::yes ? cell_style : faint_cell;
    table.rows.push_back({{{e.effect, has_panel(e) ? name_style : style}, {e.technique, note_style}},
                          {{in_words(e.wanted), style}},
                          {{or_dash(e.where), style}},
                          {{e.why, style}},
                          {{or_dash(e.saved), style}},
                          {{or_dash(e.lost), style}}});
  }
  return table;
}

// ---------------------------------------------------------------------------------------------------------------------
// Panels in rows

constexpr int widest = 2000, least_width = 1000, margin = 20, gap = 20, above_panel = 5;
/// Least width of a panel with its caption, and largest height of a panel.
constexpr int narrowest_box = 360, tallest_panel = 720;

struct Panel {
  std::vector<Paragraph> words;
  cv::Mat image, no_surface;  ///< CV_8UC3, CV_8UC1; empty: a gap in a row
  cv::Rect2d outlined;        ///< part of the image, shares; empty: none
  TextBlock caption = {};     ///< the words, at the width of the sheet's panels
};

struct Grid {
  PanelSize panel;
  int columns = 1, rows = 1;

  int width() const { return columns * (panel.box + gap) - gap; }
  int left(int column) const { return margin + column * (panel.box + gap); }
};

Grid grid_with(int columns, int panels, cv::Size image) {
  Grid grid;
  grid.columns = columns;
  grid.rows = (panels + columns - 1) / columns;
  int room = (widest - 2 * margin + gap) / columns - gap;
  // A whole fraction of the image's width is sharper than a slightly larger panel.
  const int fraction = image.width / ((image.width + room - 1) / room);
  if (image.width > room && fraction > 0.9 * room) room = fraction;
  // Enlarged images stay lower than a screen, too.
  if (image.width < narrowest_box) room = std::min(room, tallest_panel);
  grid.panel = panel_size(image.width, image.height, {narrowest_box, room, tallest_panel});
  return grid;
}

/// The number of columns that makes the panels fill a screen best.
Grid grid_for(int panels, cv::Size image) {
  constexpr double screen = 1.8;
  constexpr int caption = 45;
  const int most = std::min(panels, (widest - 2 * margin + gap) / (narrowest_box + gap));
  const auto misfit = [&](const Grid& grid) {
    const double height = grid.rows * (grid.panel.image.height + caption);
    return std::abs(std::log(grid.width() / height / screen));
  };
  Grid best = grid_with(1, panels, image);
  for (int columns = 2; columns <= most; ++columns)
    if (const Grid grid = grid_with(columns, panels, image); misfit(grid) < misfit(best)) best = grid;
  return best;
}

bool has_pictures(const std::vector<Explanation>& effects) {
  return std::any_of(effects.begin(), effects.end(),
                     [](const Explanation& e) { return has_panel(e) && e.part != nullptr; });
}

Panel panel_of_plane(const std::string& title, const std::string& note, const Plane& colour) {
  const cv::Mat image = coloured(colour);
  return {{{title, caption_style}, {note, note_style}}, image, cv::Mat(image.size(), CV_8UC1, cv::Scalar(0)), {}};
}

Panel panel_of_view(const PanelGround& ground) {
  // A sky has a colour.
  const cv::Mat nowhere(ground.no_surface.size(), CV_8UC1, cv::Scalar(0));
  return {{{ground.is_lit ? "the frame's surfaces, lit from the eye" : "the frame's colour", caption_style}},
          ground.colours,
          ground.is_lit ? ground.no_surface : nowhere,
          {}};
}

Panel panel_of_effect(const Explanation& e, const PanelGround& ground, double largest) {
  Panel panel{{{caption_of(e), caption_style}, {e.technique, note_style}, {e.says, note_style}},
              tinted(ground, e, largest),
              ground.no_surface,
              {}};
  if (e.part) panel.outlined = {e.part->left, e.part->top, e.part->width, e.part->height};
  return panel;
}

/// What belongs to an effect besides its own panel.
std::vector<Panel> pictures_of(const Explanation& e) {
  if (!e.part) return {{}, {}};
  const int step = e.part->step;
  const std::string every = step > 1 ? fmt::format("one of {0} x {0} pixels, as the look saw it", step) : "";
  return {panel_of_plane("the outlined part without " + e.effect, every, e.part->without),
          panel_of_plane("the same part with it", every, e.part->with)};
}

constexpr int columns_of_pictures = 3;

std::vector<Panel> panels_of(const std::vector<Explanation>& effects, const PanelGround& ground, const Plane* picture,
                             double largest) {
  const bool in_rows = has_pictures(effects);
  std::vector<Panel> panels = {panel_of_view(ground)};
  if (in_rows && picture) panels.push_back(panel_of_plane("the picture with all that is computed", "", *picture));
  if (in_rows) panels.resize(columns_of_pictures);
  for (const Explanation& e : effects) {
    if (!has_panel(e)) continue;
    panels.push_back(panel_of_effect(e, ground, largest));
    if (!in_rows) continue;
    for (Panel& panel : pictures_of(e)) panels.push_back(std::move(panel));
  }
  return panels;
}

/// Heights of the captions of each row of panels.
std::vector<int> caption_heights(const std::vector<Panel>& panels, const Grid& grid) {
  std::vector<int> heights(size_t(grid.rows), 0);
  for (size_t i = 0; i < panels.size(); ++i) {
    int& row = heights[i / size_t(grid.columns)];
    row = std::max(row, panels[i].caption.height);
  }
  return heights;
}

void outline(cv::Mat& canvas, const cv::Rect2d& part, cv::Point corner, cv::Size panel) {
  if (part.empty()) return;
  const auto pixels = [](double share, int whole) { return int(std::lround(share * whole)); };
  cv::rectangle(canvas,
                cv::Rect(corner.x + pixels(part.x, panel.width), corner.y + pixels(part.y, panel.height),
                         pixels(part.width, panel.width), pixels(part.height, panel.height)),
                outline_tone, 2);
}

/// Draws the panels from `top` on, each with its caption just above it.
void draw_panels(cv::Mat& canvas, const std::vector<Panel>& panels, const Grid& grid, int top) {
  const std::vector<int> captions = caption_heights(panels, grid);
  for (size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const int column = int(i) % grid.columns, row = int(i) / grid.columns;
    if (column == 0) top += captions[size_t(row)] + above_panel;
    const cv::Point corner(grid.left(column), top);
    put_block(canvas, panel.caption, corner - cv::Point(0, panel.caption.height + above_panel));
    if (!panel.image.empty()) {
      put_panel(canvas, panel.image, panel.no_surface, corner, grid.panel.image, 1);
      outline(canvas, panel.outlined, corner, grid.panel.image);
    }
    if (column == grid.columns - 1) top += grid.panel.image.height + gap;
  }
}

int height_of_panels(const std::vector<Panel>& panels, const Grid& grid) {
  int height = 0;
  for (const int caption : caption_heights(panels, grid))
    height += caption + above_panel + grid.panel.image.height + gap;
  return height;
}

// ---------------------------------------------------------------------------------------------------------------------
// The legend

/// A field of colours and its meaning.
struct Key {
  cv::Mat swatch;
  std::string text;
};

constexpr int swatch_height = 14, key_height = 24;

std::vector<Key> keys_of(const PanelGround& ground, const std::vector<Explanation>& effects, double largest) {
  const auto is_plain = [](const Explanation& e) { return has_panel(e) && !e.change; };
  std::vector<Key> keys;
  if (largest == 0 || std::any_of(effects.begin(), effects.end(), is_plain))
    keys.push_back({cv::Mat(swatch_height, 28, CV_8UC3, tint_on_paper(1)), "where the effect is called for"});
  if (largest > 0) {
    cv::Mat scale(swatch_height, 112, CV_8UC3);
    for (int x = 0; x < scale.cols; ++x) scale.col(x).setTo(tint_on_paper(double(x) / (scale.cols - 1)));
    keys.push_back({scale, fmt::format("where it is called for, by how much it changes the picture: 0 to {} or more",
                                       figure(largest))});
  }
  if (cv::countNonZero(ground.no_surface) > 0) {
    cv::Mat background(swatch_height, 28, CV_8UC3, background_tone);
    hatch(background, cv::Mat(background.size(), CV_8UC1, cv::Scalar(255)), 1);
    keys.push_back({background, "no surface"});
  }
  return keys;
}

struct PlacedKey {
  Key key;
  cv::Point at;  ///< left top corner, from that of the legend
};

/// From left to right, in as many rows as needed.
std::vector<PlacedKey> placed(std::vector<Key> keys, int width) {
  std::vector<PlacedKey> out;
  cv::Point at(0, 0);
  for (Key& key : keys) {
    const int needed = key.swatch.cols + 8 + natural_width({{key.text, legend_style}});
    if (at.x > 0 && at.x + needed > width) at = {0, at.y + key_height};
    out.push_back({std::move(key), at});
    at.x += needed + 28;
  }
  return out;
}

void draw_key(cv::Mat& canvas, const PlacedKey& placed, cv::Point corner) {
  const cv::Rect field(corner + placed.at, placed.key.swatch.size());
  placed.key.swatch.copyTo(canvas(field));
  cv::rectangle(canvas, field, rule, 1);
  put_text(canvas, placed.key.text, {field.br().x + 8, field.br().y - 2}, legend_style);
}

std::string title_of(const View& view, const std::string& title) {
  return view.name.empty() ? title : fmt::format("{}, view {}", title, view.name);
}

std::string size_of(const cv::Mat& image, const std::string& zoom) {
  return fmt::format("{} x {} pixels{}", image.cols, image.rows, zoom.empty() ? "" : fmt::format(" ({})", zoom));
}

}  // namespace

void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations, const ExplanationText& text) {
  if (!view.find("depth")) throw Error("{}: cannot explain a view without depth", path.string());
  const PanelGround ground = ground_of(view);
  const double largest = largest_change(explanations);
  std::vector<Panel> panels = panels_of(explanations, ground, text.picture, largest);
  const Grid grid = has_pictures(explanations)
                        ? grid_with(columns_of_pictures, int(panels.size()), ground.colours.size())
                        : grid_for(int(panels.size()), ground.colours.size());
  for (Panel& panel : panels) panel.caption = block_of(panel.words, grid.panel.box);
  const int room = std::max(grid.width(), least_width - 2 * margin);
  const TextBlock heading = block_of({{title_of(view, text.title), title_style},
                                      {text.sentence, totals_style},
                                      {size_of(ground.colours, grid.panel.zoom_note), note_style}},
                                     room);
  const std::vector<PlacedKey> keys = placed(keys_of(ground, explanations, largest), room);
  const PlacedTable table = placed(table_of(explanations, room), room);
  const TextBlock totals = block_of({{text.totals, totals_style}}, room);
  // From top to bottom.
  const int legend_top = margin + heading.height + 6, panels_top = legend_top + keys.back().at.y + key_height + 4;
  const int table_top = panels_top + height_of_panels(panels, grid), totals_top = table_top + table.height + 8;
  cv::Mat canvas(totals_top + totals.height + margin, room + 2 * margin, CV_8UC3, paper);
  put_block(canvas, heading, {margin, margin});
  for (const PlacedKey& key : keys) draw_key(canvas, key, {margin, legend_top});
  draw_panels(canvas, panels, grid, panels_top);
  put_table(canvas, table, {margin, table_top});
  put_block(canvas, totals, {margin, totals_top});
  write_png(path, canvas);
}

}  // namespace gloam
