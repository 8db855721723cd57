#include "scene/bright_texels.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

constexpr double pi = glm::pi<double>();

/// A map whose bright texels hold less than this share of its light is even.
constexpr double least_share = 0.02;

/// Sine of the angle to the pole in the middle of a row: the size of its texels.
double size_of(int row, int height) { return std::sin(pi * (row + 0.5) / height); }

/// Replaces weights by their cumulated shares; returns their sum.
double cumulate(double* weights, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; ++i) weights[i] = sum += weights[i];
  if (sum > 0) {
    for (size_t i = 0; i < count; ++i) weights[i] /= sum;
    weights[count - 1] = 1;
  }
  return sum;
}

/// The interval of cumulated shares that holds u, which becomes the place within it.
int drawn(const double* shares, int count, double& u) {
  const int i = std::min(int(std::upper_bound(shares, shares + count, u) - shares), count - 1);
  const double before = i > 0 ? shares[i - 1] : 0, width = shares[i] - before;
  u = width > 0 ? std::clamp((u - before) / width, 0.0, 1.0) : 0.5;
  return i;
}

/// From -1 to 1, with the density of a tent: how much a texel counts at this distance from its middle.
double tent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

}  // namespace

BrightTexels::BrightTexels(const EnvironmentMap& map) : map_(map) {
  const int width = map.width(), height = map.height();
  const auto row_of = [&](int y) { return columns_.data() + size_t(y) * size_t(width); };
  columns_.reserve(map.texels().size());
  for (const vec3& texel : map.texels()) columns_.push_back(double(texel.x) + double(texel.y) + double(texel.z));
  double light = 0, sizes = 0;
  for (int y = 0; y < height; ++y) {
    sizes += width * size_of(y, height);
    for (int x = 0; x < width; ++x) light += row_of(y)[x] * size_of(y, height);
  }
  for (double& brightness : columns_) brightness = std::max(brightness - light / sizes, 0.0);
  double above = 0;
  for (int y = 0; y < height; ++y) {
    rows_.push_back(size_of(y, height) * cumulate(row_of(y), size_t(width)));
    above += rows_.back();
  }
  if (above > least_share * light)
    cumulate(rows_.data(), rows_.size());
  else
    rows_.clear();
}

double BrightTexels::probability(int x, int y) const {
  const double* columns = columns_.data() + size_t(y) * size_t(map_.width());
  const double row = rows_[size_t(y)] - (y > 0 ? rows_[size_t(y) - 1] : 0);
  return row * (columns[x] - (x > 0 ? columns[x - 1] : 0));
}

dvec3 BrightTexels::direction(const dvec2& u) const {
  double across = u.x, down = u.y;
  const int row = drawn(rows_.data(), map_.height(), down);
  const int column = drawn(columns_.data() + size_t(row) * size_t(map_.width()), map_.width(), across);
  // Beyond a pole lies the same row again, as in the map's own radiance.
  double y = std::abs(row + 0.5 + tent(down));
  if (y > map_.height()) y = 2 * map_.height() - y;
  return map_.direction({column + 0.5 + tent(across), y});
}

double BrightTexels::density(const dvec3& direction) const {
  if (!any()) return 0;
  const dvec2 place = map_.place(direction), at = place - 0.5;
  const double left = std::floor(at.x), top = std::floor(at.y), u = at.x - left, v = at.y - top;
  const auto texel = [&](int dx, int dy) {
    return probability((int(left) + dx + map_.width()) % map_.width(), std::clamp(int(top) + dy, 0, map_.height() - 1));
  };
  const double per_texel =
      (1 - v) * ((1 - u) * texel(0, 0) + u * texel(1, 0)) + v * ((1 - u) * texel(0, 1) + u * texel(1, 1));
  const double from_pole = place.y / map_.height() * pi;
  const double size = 2 * pi / map_.width() * pi / map_.height() * std::max(std::sin(from_pole), 1e-12);
  return per_texel / size;
}

}  // namespace gloam
