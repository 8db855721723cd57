#include "papers/panels.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "picture/inconsistency_image.h"
#include "picture/picture.h"

namespace gloam::bench {
namespace {

constexpr PanelLimits limits{240, 640, 640};
constexpr int gap = 12, label_height = 26;

cv::Mat shown(const Panel& panel) {
  return panel.errors ? inconsistency_image(panel.plane, *panel.errors, error_magnification) : coloured(panel.plane);
}

}  // namespace

void write_panels(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns) {
  const Layout& layout = panels.front().plane.channels.front().layout();
  const PanelSize size = panel_size(layout.width, layout.height, limits);
  columns = std::min(columns, int(panels.size()));
  const int rows = (int(panels.size()) + columns - 1) / columns;
  const int across = size.box + gap, down = size.image.height + label_height + gap;
  cv::Mat canvas(rows * down + gap, columns * across + gap, CV_8UC3, paper);
  for (size_t i = 0; i < panels.size(); ++i) {
    const int x = gap + int(i) % columns * across, y = gap + int(i) / columns * down;
    const TextStyle style{10, ink, true};
    put_text(canvas, shortened(panels[i].label, size.box, style), {x, y + 16}, style);
    const cv::Mat colours = shown(panels[i]), nothing = cv::Mat::zeros(colours.size(), CV_8UC1);
    put_panel(canvas, colours, nothing, {x, y + label_height}, size.image, 1);
  }
  write_png(path, canvas);
}

}  // namespace gloam::bench
