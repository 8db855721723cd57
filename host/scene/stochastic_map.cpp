#include "scene/stochastic_map.h"

#include <bit>
#include <utility>

#include "shared/both/stochastic.h"

namespace gloam {

const std::vector<std::string>& stochastic_surfaces() {
  static const std::vector<std::string> names = {"all", "hidden", "relevant"};
  return names;
}

const std::vector<std::string>& stochastic_subsets() {
  static const std::vector<std::string> names = {"stratified", "nearest"};
  return names;
}

bool is_of_relevant(const StochasticOptions& options) {
  return options.samples > 0 && options.surfaces == StochasticSurfaces::relevant;
}

void say_stochastic(Frame& frame, const StochasticOptions& options) {
  frame.attributes["gloamStochasticSurfaces"] = stochastic_surfaces()[size_t(options.surfaces)];
  frame.attributes["gloamStochasticSubset"] = stochastic_subsets()[size_t(options.subset)];
  if (is_of_relevant(options)) {
    frame.numbers["gloamStochasticRadius"] = options.radius.value_or(0);
    frame.numbers["gloamStochasticReach"] = options.max_reach;
  }
  if (options.subset == StochasticSubset::nearest) return;
  frame.numbers["gloamStochasticAlpha"] = options.alpha;
  frame.attributes["gloamStochasticSeed"] = std::to_string(options.seed);
}

StochasticMap::StochasticMap(const StochasticOptions& options, const Window& window,
                             const std::vector<Channel*>& samples)
    : alpha_(uint32_t(float(options.alpha) * float(STOCHASTIC_ONE))),
      seed_(uint32_t(options.seed)),
      only_hidden_(options.surfaces != StochasticSurfaces::all),
      only_relevant_(options.surfaces == StochasticSurfaces::relevant),
      nearest_first_(options.subset == StochasticSubset::nearest),
      radius_(options.radius.value_or(0)),
      max_reach_(options.max_reach),
      window_(window),
      samples_(samples) {
  if (only_relevant_ && is_wanted()) kept_.resize(size_t(window.height()));
}

void StochasticMap::row(int y, RowDepths row) {
  if (kept_.empty())
    choose(y, row);
  else
    kept_[size_t(y)] = std::move(row);
}

void StochasticMap::choose_among_kept(const Channel& depth, const Camera& camera) {
  if (kept_.empty()) return;
  relevant_ = RelevantSlices(depth, camera, window_, radius_, max_reach_);
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < int(kept_.size()); ++y) choose(y, kept_[size_t(y)]);
  kept_.clear();
}

void StochasticMap::choose(int y, const RowDepths& row) const {
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
    if (only_hidden_ && *depth == *begin) continue;
    if (only_relevant_ && !relevant_.hold(x, y, *depth)) continue;
    const uint32_t offered = subset(x, y, *depth, *begin, empty);
    for (uint32_t left = offered; left != 0; left &= left - 1)
      samples_[size_t(std::countr_zero(left))]->at(x, y) = *depth;
    empty &= ~offered;
  }
}

/// The samples, among those that are `empty`, that a surface is offered to.
uint32_t StochasticMap::subset(int x, int y, float depth, float nearest, uint32_t empty) const {
  if (nearest_first_) return empty & (~empty + 1);  // the first
  const uint32_t hash = surface_hash(uint32_t(x + window_.x0), uint32_t(y + window_.y0), seed_,
                                     std::bit_cast<uint32_t>(depth), std::bit_cast<uint32_t>(nearest));
  return stratified_subset(hash, alpha_, static_cast<unsigned int>(samples_.size())) & empty;
}

}  // namespace gloam
