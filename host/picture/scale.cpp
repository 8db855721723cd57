#include "picture/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "gloam/error.h"

namespace gloam {
namespace {

/// Number of values sampled to find the ends of the colours.
constexpr size_t sample_size = 200'000;

/// Ends of the colours: the range, or the range without the outermost 1 % of the values if that is less than half of it: a few
/// outliers must not wash out the rest. Positions go without their outermost 10 %: points near the horizon are few pixels and
/// most of the range.
void choose_ends(Range& range, std::vector<float>& sample, PictureStyle style) {
  range.first = range.low;
  range.last = range.high;
  if (sample.empty()) return;
  std::sort(sample.begin(), sample.end());
  const size_t outside = sample.size() / (style == PictureStyle::position ? 20 : 200);
  const double first = sample[outside], last = sample[sample.size() - 1 - outside];
  const bool much_narrower = last - first < 0.5 * (range.high - range.low);
  if (last <= first || (style != PictureStyle::position && !much_narrower)) return;
  range.first = first;
  range.last = last;
}

/// Values of one component, and a sample of them for the ends of the colours.
struct Values {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<float> sample;
};

Values values_of(const Tile& tile, size_t component, long long step) {
  Values values;
  Range& range = values.range;
  for (int y = 0; y < tile.layout().height; ++y)
    for (int x = 0; x < tile.layout().width; ++x) {
      if (tile.is_background(x, y)) continue;
      const double v = value_at(tile, component, x, y);
      if (!std::isfinite(v)) continue;
      range.low = std::min(range.low, v);
      range.high = std::max(range.high, v);
      if (range.finite++ % step == 0) values.sample.push_back(float(v));
    }
  return values;
}

/// Range over the tiles that share a scale.
Range range_of(const std::vector<const Tile*>& tiles, size_t component) {
  size_t pixels = 0;
  for (const Tile* tile : tiles) pixels += size_t(tile->layout().width) * size_t(tile->layout().height);
  const long long step = 1 + (long long)(pixels / sample_size);
  std::vector<Values> of_tiles(tiles.size());
  cv::parallel_for_(cv::Range(0, int(tiles.size())), [&](const cv::Range& part) {
    for (int i = part.start; i < part.end; ++i) of_tiles[size_t(i)] = values_of(*tiles[size_t(i)], component, step);
  });
  Values all;
  for (const Values& values : of_tiles) {
    all.range.low = std::min(all.range.low, values.range.low);
    all.range.high = std::max(all.range.high, values.range.high);
    all.range.finite += values.range.finite;
    all.sample.insert(all.sample.end(), values.sample.begin(), values.sample.end());
  }
  if (all.range.finite == 0) all.range.low = all.range.high = 0;
  choose_ends(all.range, all.sample, tiles.front()->style);
  return all.range;
}

const std::string depth_key = "all depths";

}  // namespace

double Range::position(double v) const {
  return last > first ? std::clamp((v - first) / (last - first), 0.0, 1.0) : 0.5;
}

std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles) {
  std::vector<Range> ranges;
  for (size_t c = 0; c < components_of(*tiles.front()); ++c) ranges.push_back(range_of(tiles, c));
  return ranges;
}

std::string scale_key(const Tile& tile) {
  return tile.style == PictureStyle::depth ? depth_key
                                           : fmt::format("{} {}", tile.plane->name, tile.plane->channels.size());
}

Scales scales_of(const std::vector<Tile>& tiles) {
  std::map<std::string, std::vector<const Tile*>> alike;
  for (const Tile& tile : tiles) alike[scale_key(tile)].push_back(&tile);
  Scales scales;
  for (const auto& [key, group] : alike) scales[key] = ranges_of(group);
  return scales;
}

const Range* depth_scale(const Scales& scales) {
  const auto found = scales.find(depth_key);
  return found == scales.end() ? nullptr : &found->second.front();
}

}  // namespace gloam
