#include "picture/wordings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "gloam/error.h"

namespace gloam {
namespace {

std::string span(double low, double high) {
  return low == high ? figure(low) + " everywhere" : figure(low) + " .. " + figure(high);
}

size_t different_values(const std::vector<const Tile*>& tiles) {
  std::unordered_set<uint32_t> values;
  for (const Tile* tile : tiles)
    for (int y = 0; y < tile->layout().height; ++y)
      for (int x = 0; x < tile->layout().width; ++x)
        if (!tile->is_background(x, y)) values.insert(std::bit_cast<uint32_t>(tile->plane->channels[0].at(x, y)));
  return values.size();
}

/// The union of the ranges of all components.
Range united(const std::vector<Range>& ranges) {
  Range all = ranges.front();
  for (const Range& range : ranges) {
    if (range.finite == 0) continue;
    all.low = all.finite == 0 ? range.low : std::min(all.low, range.low);
    all.high = all.finite == 0 ? range.high : std::max(all.high, range.high);
    all.finite = std::max(all.finite, range.finite);
  }
  return all;
}

long long pixels_not_finite(const std::vector<const Tile*>& tiles) {
  long long count = 0;
  for (const Tile* tile : tiles)
    for (int y = 0; y < tile->layout().height; ++y)
      for (int x = 0; x < tile->layout().width; ++x) count += !tile->is_background(x, y) && !is_finite(*tile, x, y);
  return count;
}

Wordings axes(const std::vector<Range>& r) {
  const auto axis = [&](size_t c) { return fmt::format("{} {} .. {}", "xyz"[c], figure(r[c].low), figure(r[c].high)); };
  const auto extent = [&](size_t c) { return figure(r[c].high - r[c].low); };
  return {fmt::format("{}, {}, {}", axis(0), axis(1), axis(2)),
          fmt::format("{} x {} x {} across", extent(0), extent(1), extent(2))};
}

std::string instances(size_t count) { return fmt::format("{} instance{}", count, count == 1 ? "" : "s"); }

/// The range, and the part of it that is drawn.
Wordings scalar_range(const Range& all, const Range& drawn) {
  const std::string text = span(all.low, all.high);
  if (drawn.first <= all.low && drawn.last >= all.high) return {text};
  return {fmt::format("{}, drawn {} .. {}", text, figure(drawn.first), figure(drawn.last)), text};
}

/// The meaning of the values of the tiles.
Wordings values_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                         const std::vector<Range>& scale) {
  const Range all = united(own);
  switch (tiles.front()->style) {
    case PictureStyle::depth:
      return {span(std::exp(all.low), std::exp(all.high))};
    case PictureStyle::direction:
      return {"x, y, z as red, green, blue", "unit vectors"};
    case PictureStyle::identity:
      return {instances(different_values(tiles))};
    case PictureStyle::position:
      return axes(own);
    case PictureStyle::motion:
      return {fmt::format("hue: direction; longest {} pixels", figure(all.high)),
              fmt::format("longest {} pixels", figure(all.high))};
    case PictureStyle::scalar:
      return scalar_range(all, scale.front());
    default:
      return {span(all.low, all.high)};
  }
}

}  // namespace

std::string figure(double v) { return fmt::format("{:.3g}", v == 0 ? 0.0 : v); }

Wordings range_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                        const std::vector<Range>& scale) {
  const long long not_finite = pixels_not_finite(tiles);
  if (united(own).finite == 0) return {not_finite == 0 ? "no surface" : "nothing finite"};
  Wordings wordings = values_in_words(tiles, own, scale);
  for (std::string& wording : wordings)
    if (not_finite > 0) wording += fmt::format(", {} not finite", not_finite);
  return wordings;
}

std::string fitting(const Wordings& wordings, double width, const TextStyle& style) {
  const auto fits = [&](const std::string& wording) { return text_width(wording, style) <= width; };
  return shortened(*std::find_if(wordings.begin(), wordings.end() - 1, fits), width, style);
}

}  // namespace gloam
