// A stochastic depth map from all surfaces under the pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gloam/scene/capture.h"

namespace gloam {

/// Depths of all surfaces under the pixels of a row.
struct RowDepths {
  std::vector<float> depths;  ///< pixel after pixel, each front to back
  std::vector<size_t> ends;   ///< end of each pixel's depths, in `depths`
};

/// Makes one view's stochastic depth map, with the same bits as kernels/stochastic_depth from the same surfaces.
class StochasticMap {
 public:
  StochasticMap(const StochasticOptions& options, const std::vector<Channel*>& samples);

  bool is_wanted() const { return !samples_.empty(); }

  void row(int y, const RowDepths& row) const;

 private:
  void pixel(int x, int y, const float* begin, const float* end) const;

  uint32_t alpha_, seed_;
  const std::vector<Channel*>& samples_;
};

}  // namespace gloam
