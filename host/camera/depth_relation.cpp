#include "camera/depth_relation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gloam {
namespace {

using Pixels = std::vector<PositionedPixel>;

/// A typical depth that follows a reading deviates by rounding alone; one of another kind by several percent.
constexpr double largest_deviation = 0.02, told_apart = 4, rounding = 1e-4;
constexpr size_t fewest = 20;

struct Ratios {
  double median = 1, deviation = 0;  ///< the latter relative
};

Ratios ratios_of(const std::vector<double>& ratios) {
  Ratios found{share_below(ratios, 0.5)};
  std::vector<double> deviations;
  for (const double ratio : ratios) deviations.push_back(std::abs(ratio / found.median - 1));
  found.deviation = share_below(std::move(deviations), 0.5);
  return found;
}

double depth_of(const Camera& camera, const PositionedPixel& pixel) {
  return -(camera.pose->world_to_view * (pixel.world - camera.pose->position)).z;
}

}  // namespace

DepthRelation relate_depth(const Camera& camera, const Pixels& pixels) {
  std::vector<double> planar, along;
  for (const PositionedPixel& pixel : pixels) {
    const double depth = depth_of(camera, pixel), length = glm::distance(pixel.world, camera.pose->position);
    if (!std::isfinite(pixel.depth) || !(depth > 0)) continue;
    planar.push_back(pixel.depth / depth);
    along.push_back(pixel.depth / length);
  }
  if (planar.size() < fewest) return {};
  const Ratios by_plane = ratios_of(planar), by_ray = ratios_of(along);
  const bool is_planar = by_plane.deviation <= by_ray.deviation;
  const Ratios &best = is_planar ? by_plane : by_ray, &other = is_planar ? by_ray : by_plane;
  if (!(best.deviation <= largest_deviation)) return {DepthRelation::neither};
  if (other.deviation <= told_apart * best.deviation + rounding) return {DepthRelation::unknown, best.median};
  return {is_planar ? DepthRelation::planar : DepthRelation::along_ray, best.median};
}

DepthRelation place_by_depth(Camera& camera, const Pixels& pixels) {
  // A line through depths by position along the axis, from pairs of pixels, so that single wild ones do not tilt it.
  std::vector<double> slopes, offsets;
  std::vector<std::pair<double, double>> pairs;
  for (const PositionedPixel& pixel : pixels)
    if (std::isfinite(pixel.depth)) pairs.emplace_back(depth_of(camera, pixel), pixel.depth);
  if (pairs.size() < fewest) return {};
  std::sort(pairs.begin(), pairs.end());
  const double extent = pairs.back().first - pairs.front().first;
  for (size_t i = 0, half = pairs.size() / 2; i + half < pairs.size(); ++i) {
    const double across = pairs[i + half].first - pairs[i].first;
    if (across > 1e-3 * extent) slopes.push_back((pairs[i + half].second - pairs[i].second) / across);
  }
  if (slopes.size() < fewest / 2) return {};
  const double slope = share_below(slopes, 0.5);
  std::vector<double> deviations;
  for (const auto& [along, depth] : pairs) offsets.push_back(depth / slope - along);
  const double offset = share_below(offsets, 0.5);
  for (const double each : offsets) deviations.push_back(std::abs(each - offset));
  if (!(share_below(std::move(deviations), 0.5) <= largest_deviation * extent)) return {DepthRelation::neither};
  const glm::dvec3 back = glm::transpose(camera.pose->world_to_view) * glm::dvec3(0, 0, 1);
  camera.pose->position += offset * back;
  if (slope < 0)  // the other way along the axis: rows of the matrix are the view's axes
    for (int c = 0; c < 3; ++c) camera.pose->world_to_view[c].z *= -1;
  return {DepthRelation::planar, std::abs(slope)};
}

}  // namespace gloam
