#include "scene/relevant_slices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/planes.h"
#include "shared/both/relevant.h"

namespace gloam {
namespace {

constexpr int tile_size = RELEVANT_TILE;

/// The frame as kernels see it, but for what the slices do not depend on.
relevance::Frame frame_of_tiles(const Layout& layout, const Camera& camera, const Window& window) {
  return {layout.width,
          layout.height,
          layout.pitch,
          0,
          float(1 / camera.fx),
          float(1 / camera.fy),
          float(camera.cx - window.x0),
          float(camera.cy - window.y0),
          camera.orthographic ? 0.0f : 1.0f,
          camera.orthographic ? 1.0f : 0.0f};
}

}  // namespace

RelevantSlices::RelevantSlices(const Channel& depth, const Camera& camera, const Window& window, double radius,
                               double max_reach)
    : radius_(float(radius)) {
  const Layout tiles = reduced(depth.layout(), tile_size);
  columns_ = tiles.width, rows_ = tiles.height;
  const Tiles rows = across(shown(depth, camera, window, float(max_reach)));
  slices_.assign(rows.slices.size(), 0);
  for (int y = 0; y < rows_; ++y) {
    for (int row = 0; row < rows_; ++row) {
      const float gap = relevance::gap_between(float(row - y));
      for (int x = 0; x < columns_; ++x)
        if (gap <= rows.reach[index(x, row)]) slices_[index(x, y)] |= rows.slices[index(x, row)];
    }
  }
}

/// What each tile shows, and how far that looks for occluders.
RelevantSlices::Tiles RelevantSlices::shown(const Channel& depth, const Camera& camera, const Window& window,
                                            float max_reach) const {
  const relevance::Frame frame = frame_of_tiles(depth.layout(), camera, window);
  Tiles tiles{std::vector<uint32_t>(size_t(columns_) * size_t(rows_)), {}};
  tiles.reach.resize(tiles.slices.size());
  if (!(radius_ > 0)) return tiles;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const int x0 = column * tile_size, y0 = row * tile_size;
      uint32_t slices = 0;
      float nearest = std::numeric_limits<float>::infinity();
      for (int y = y0; y < std::min(y0 + tile_size, frame.height); ++y) {
        for (int x = x0; x < std::min(x0 + tile_size, frame.width); ++x) {
          const float seen = depth.at(x, y);
          if (is_background(seen)) continue;
          slices |= relevance::slice_of(seen, radius_);
          nearest = std::min(nearest, seen);
        }
      }
      if (slices == 0) continue;
      tiles.slices[index(column, row)] = relevance::with_slices_beside(slices);
      tiles.reach[index(column, row)] = relevance::reach_in_tiles(frame, float(x0) + tile_size / 2 - frame.centre_x,
                                                                  float(y0 + tile_size / 2) - frame.centre_y, nearest,
                                                                  radius_, max_reach * float(frame.width));
    }
  }
  return tiles;
}

/// The slices of all tiles of a row that reach each tile of it, and how far up and down these still reach.
RelevantSlices::Tiles RelevantSlices::across(const Tiles& shown) const {
  Tiles rows{std::vector<uint32_t>(shown.slices.size()), std::vector<float>(shown.slices.size())};
  for (int row = 0; row < rows_; ++row) {
    for (int x = 0; x < columns_; ++x) {
      float most = 0;
      for (int column = 0; column < columns_; ++column) {
        const float far = shown.reach[index(column, row)], gap = relevance::gap_between(float(x - column));
        if (gap > far) continue;
        rows.slices[index(x, row)] |= shown.slices[index(column, row)];
        most = std::max(most, far * far - gap * gap);
      }
      rows.reach[index(x, row)] = std::sqrt(most);
    }
  }
  return rows;
}

bool RelevantSlices::hold(int x, int y, float depth) const {
  if (slices_.empty()) return false;
  return (slices_[index(x / tile_size, y / tile_size)] & relevance::slice_of(depth, radius_)) != 0;
}

}  // namespace gloam
