#include "page/pictures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "picture/picture.h"

namespace gloam::report {
namespace {

namespace fs = std::filesystem;

constexpr int margin = 16, gap = 12, header = 52, caption = 32, columns = 3;
constexpr int widest_tile = 320, narrowest_tile = 80;  ///< pixels
constexpr int narrowest_box = 160;                     ///< leaves room for a readable caption
const TextStyle title_style{11, ink, true}, about_style{7, faint}, name_style{8, ink, true}, figures_style{7.5, ink};

void draw(cv::Mat& canvas, const Tile& tile, cv::Point corner, const PanelSize& panel) {
  put_text(canvas, shortened(tile.name, panel.box, name_style), corner - cv::Point(0, 19), name_style);
  put_text(canvas, shortened(tile.figures, panel.box, figures_style), corner - cv::Point(0, 6), figures_style);
  cv::Mat grey, alpha, colours;
  cv::extractChannel(tile.grey_alpha, grey, 0);
  cv::extractChannel(tile.grey_alpha, alpha, 1);
  cv::cvtColor(grey, colours, cv::COLOR_GRAY2BGR);
  put_panel(canvas, colours, alpha < 128, corner, panel.image, 0.8);
}

/// The sheet with tiles of one width. CV_8UC1.
cv::Mat sheet(const std::string& title, const std::string& about, const std::vector<Tile>& tiles, int tile_width) {
  const cv::Size first = tiles.front().grey_alpha.size();
  const PanelSize panel = panel_size(first.width, first.height, {narrowest_box, tile_width, 2 * tile_width});
  const int rows = (int(tiles.size()) + columns - 1) / columns;
  const int width = 2 * margin + columns * panel.box + (columns - 1) * gap;
  cv::Mat canvas(header + rows * (caption + panel.image.height + gap) - gap + margin, width, CV_8UC3, paper), grey;
  put_text(canvas, shortened(title, width - 2 * margin, title_style), {margin, 27}, title_style);
  put_text(canvas, shortened(about, width - 2 * margin, about_style), {margin, 43}, about_style);
  for (int i = 0; i < int(tiles.size()); ++i) {
    const cv::Point corner(margin + i % columns * (panel.box + gap),
                           header + i / columns * (caption + panel.image.height + gap) + caption);
    draw(canvas, tiles[size_t(i)], corner, panel);
  }
  cv::cvtColor(canvas, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

cv::Mat stored_picture(const fs::path& folder, const std::string& name) {
  const fs::path relative = fs::path(name).lexically_normal();
  // A foreign bench.json must not put other files of this machine into a page that is passed on.
  if (relative.is_absolute() || *relative.begin() == "..") throw Error("{}: is not below {}", name, folder.string());
  std::error_code unknown;
  if (!fs::is_regular_file(folder / relative, unknown)) throw Error("{}: is no file", (folder / relative).string());
  return read_png(folder / relative);
}

std::string sheet_png(const std::string& title, const std::string& about, const std::vector<Tile>& tiles,
                      size_t most_bytes) {
  std::string png;
  for (int width = widest_tile; width >= narrowest_tile; width -= 40) {
    png = encode_png(sheet(title, about, tiles, width));
    if (png.size() <= most_bytes) break;
  }
  return png;
}

}  // namespace gloam::report
