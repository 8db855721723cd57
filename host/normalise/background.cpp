#include "normalise/background.h"

#include <cmath>

#include "normalise/each_row.h"

namespace gloam {

namespace {

/// Depths from here on are never surfaces: positions would leave the range of float with any camera.
constexpr float beyond_reach = 1e20f;

}  // namespace

Background background_of(std::optional<float> value, std::optional<double> far) {
  Background background;
  if (value) {
    background.value = *value;
    background.from = beyond_reach;
  }
  if (far && std::isfinite(*far)) {
    background.far_low = float(*far * (1 - 2e-7));  // two roundings of float
    background.far_high = float(*far * (1 + 2e-7));
  }
  return background;
}

void clean_depth_row(float* row, int width, float sign, const Background& background) {
  for (int x = 0; x < width; ++x) {
    const float raw = row[x], depth = sign * raw;
    const bool surface = is_surface(depth, background) & (raw != background.value);
    row[x] = surface ? depth : infinity;
  }
}

void clean_depth(Channel& depth, float sign, const Background& background) {
  for_each_row(depth.layout(), [&](int y) { clean_depth_row(depth.row(y), depth.layout().width, sign, background); });
}

}  // namespace gloam
