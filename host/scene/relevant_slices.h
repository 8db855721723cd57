// Which depths under a pixel may be within the radius of something visible.
#pragma once

#include <cstdint>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Slices of depth by tile of pixels (kernels/shared/both/relevant.h), with the same bits as kernels/stochastic_depth makes from the same
/// depth.
class RelevantSlices {
 public:
  /// Nothing is relevant.
  RelevantSlices() = default;
  /// `depth`: of `window`, by a camera without slits. `radius`: scene units; `max_reach`: cap on it on the screen, in widths of the window.
  RelevantSlices(const Channel& depth, const Camera& camera, const Window& window, double radius, double max_reach);

  /// Whether a surface at this depth, which is not infinite, under a pixel of the channel may be.
  bool hold(int x, int y, float depth) const;

 private:
  struct Tiles {
    std::vector<uint32_t> slices;
    std::vector<float> reach;  ///< in tiles
  };
  size_t index(int column, int row) const { return size_t(row) * size_t(columns_) + size_t(column); }
  Tiles shown(const Channel& depth, const Camera& camera, const Window& window, float max_reach) const;
  Tiles across(const Tiles& shown) const;

  float radius_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<uint32_t> slices_;
};

}  // namespace gloam
