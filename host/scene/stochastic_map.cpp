#include "scene/stochastic_map.h"

#include <bit>

#include "shared/both/stochastic.h"

namespace gloam {

StochasticMap::StochasticMap(const StochasticOptions& options, const std::vector<Channel*>& samples)
    : alpha_(uint32_t(float(options.alpha) * float(STOCHASTIC_ONE))),
      seed_(uint32_t(options.seed)),
      samples_(samples) {}

void StochasticMap::row(int y, const RowDepths& row) const {
  size_t begin = 0;
  for (size_t x = 0; x < row.ends.size(); ++x) {
    pixel(int(x), y, row.depths.data() + begin, row.depths.data() + row.ends[x]);
    begin = row.ends[x];
  }
}

// Front to back, so that a sample keeps the first depth that it is offered.
void StochasticMap::pixel(int x, int y, const float* begin, const float* end) const {
  const auto samples = static_cast<unsigned int>(samples_.size());
  uint32_t empty = (1u << samples) - 1;
  for (const float* depth = begin; depth < end && empty != 0; ++depth) {
    const uint32_t hash =
        surface_hash(uint32_t(x), uint32_t(y), seed_, std::bit_cast<uint32_t>(*depth), std::bit_cast<uint32_t>(*begin));
    const uint32_t subset = stratified_subset(hash, alpha_, samples) & empty;
    for (uint32_t left = subset; left != 0; left &= left - 1)
      samples_[size_t(std::countr_zero(left))]->at(x, y) = *depth;
    empty &= ~subset;
  }
}

}  // namespace gloam
