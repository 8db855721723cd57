// A stochastic depth map from all surfaces under the pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gloam/scene/capture.h"
#include "scene/relevant_slices.h"

namespace gloam {

/// Depths of all surfaces under the pixels of a row.
struct RowDepths {
  std::vector<float> depths;  ///< pixel after pixel, each front to back
  std::vector<size_t> ends;   ///< end of each pixel's depths, in `depths`
};

/// States in a frame's attributes how its map was made.
void say_stochastic(Frame& frame, const StochasticOptions& options);

/// Makes one view's stochastic depth map, with the same bits as kernels/stochastic_depth from the same surfaces.
class StochasticMap {
 public:
  /// `window`: of the channels. Random choices go by the pixel's place in the picture, whatever lies around it. For relevant surfaces
  /// the options have a radius.
  StochasticMap(const StochasticOptions& options, const Window& window, const std::vector<Channel*>& samples);

  bool is_wanted() const { return !samples_.empty(); }

  /// Chooses among a row's surfaces, or keeps them until all of the view is known. Rows may come on several threads at once.
  void row(int y, RowDepths row);

  /// Chooses among the rows that were kept. `depth`: what the view shows.
  void choose_among_kept(const Channel& depth, const Camera& camera);

 private:
  void choose(int y, const RowDepths& row) const;
  void pixel(int x, int y, const float* begin, const float* end) const;
  uint32_t subset(int x, int y, float depth, float nearest, uint32_t empty) const;

  uint32_t alpha_, seed_;
  bool only_hidden_, only_relevant_, nearest_first_;
  double radius_, max_reach_;
  Window window_;
  const std::vector<Channel*>& samples_;
  std::vector<RowDepths> kept_;  ///< of all rows, where what is relevant decides
  RelevantSlices relevant_;
};

}  // namespace gloam
