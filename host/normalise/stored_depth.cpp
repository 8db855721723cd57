#include "normalise/stored_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/projection.h"
#include "normalise/each_row.h"

namespace gloam {
namespace {

constexpr float largest_half = 65504;
/// A mark for the background, by chance on a surface here and there.
constexpr long long fewest_marked = 64;
constexpr double least_share_marked = 0.001;
/// Steps of this share of a pixel's width are told. AO (gtao) of a floor and a wall was off by an RMSE of 0.0055 at 0.16, 0.016 at 0.31 and 0.034 at
/// 0.62.
constexpr double longest_step = 0.25;

struct Counts {
  long long positive = 0, negative = 0, over_one = 0, largest = 0, beyond = 0;
};

Counts counts_of(const DepthRows& depth, const Background& background) {
  long long positive = 0, negative = 0, over_one = 0, largest = 0, beyond = 0;
#pragma omp parallel for reduction(+ : positive, negative, over_one, largest, beyond) \
    if (size_t(depth.width) * size_t(depth.height) > 65536)
  for (int y = 0; y < depth.height; ++y) {
    const float* row = depth.row(y);
    int in_row[5] = {};
    for (int x = 0; x < depth.width; ++x) {
      const bool surface = is_surface(row[x], background);
      in_row[0] += surface;
      in_row[1] += is_surface(-row[x], background) & (row[x] != background.value);
      in_row[2] += surface & (row[x] > 1);
      in_row[3] += surface & (row[x] == largest_half);
      in_row[4] += surface & (row[x] > largest_half);
    }
    positive += in_row[0], negative += in_row[1], over_one += in_row[2], largest += in_row[3], beyond += in_row[4];
  }
  return {positive, negative, over_one, largest, beyond};
}

/// Distance to the next value that the type holds.
double step_at(float depth, bool is_half) {
  if (!is_half) return std::nextafter(depth, std::numeric_limits<float>::infinity()) - depth;
  return std::ldexp(1.0, std::max(-24, std::ilogb(depth) - 10));
}

}  // namespace

DepthRows rows_of(const Channel& channel) {
  return {[&channel](int y) { return channel.row(y); }, channel.layout().width, channel.layout().height};
}

std::string note_on_planar_depth(bool is_in_unit_interval) {
  return fmt::format("depth: taken as planar distance along the viewing axis{}; {} says otherwise",
                     is_in_unit_interval ? ", though all of it lies in 0..1" : "", option("depth"));
}

bool is_a_mark(long long pixels, long long of) {
  return pixels >= fewest_marked && double(pixels) >= least_share_marked * double(of);
}

double mark_share(Channel& depth, float value) {
  const int width = depth.layout().width;
  long long count = 0;
#pragma omp parallel for reduction(+ : count)
  for (int y = 0; y < depth.layout().height; ++y) count += std::count(depth.row(y), depth.row(y) + width, value);
  const long long pixels = (long long)width * depth.layout().height;
  if (!is_a_mark(count, pixels)) return 0;
  for_each_row(depth.layout(), [&](int y) { std::replace(depth.row(y), depth.row(y) + width, value, infinity); });
  return double(count) / double(pixels);
}

StoredDepth look_at_depth(const DepthRows& depth, const Background& background, bool is_stated,
                          const std::string& remedy) {
  const Counts counts = counts_of(depth, background);
  const long long pixels = (long long)depth.width * depth.height;
  StoredDepth found{.background = background};
  const bool is_negative = counts.negative > 0 && counts.positive == 0;
  long long surfaces = counts.positive;
  if (!is_stated && counts.beyond == 0 && is_a_mark(counts.largest, pixels)) {
    found.background.value = largest_half;
    surfaces -= counts.largest;
    found.notes.push_back(
        fmt::format("depth: {:.1f} % of the pixels are 65504, the largest half, and taken as background{}",
                    100 * double(counts.largest) / double(pixels), remedy));
  }
  if (is_negative) {
    found.sign = -1;
    found.notes.emplace_back("depth: all of it is negative, taken as the z of a camera that looks along -z");
  } else if (counts.negative > 0) {
    found.notes.push_back(fmt::format("depth: {} negative value{} among positive ones taken as background",
                                      counts.negative, counts.negative == 1 ? "" : "s"));
  }
  found.is_usable = is_negative || surfaces > 0;
  found.is_in_unit_interval = counts.positive > 0 && counts.over_one == 0;
  return found;
}

std::string note_on_steps(const std::function<float(int x, int y)>& depth, const Layout& image, const Camera& camera,
                          bool is_half) {
  if (!camera.orthographic) return "";
  const int cell = std::max(1, int(std::sqrt(double(image.width) * image.height / 1024)));
  std::vector<float> depths;
  for (int y = cell / 2; y < image.height; y += cell) {
    for (int x = cell / 2; x < image.width; x += cell) {
      if (const float z = depth(x, y); !is_background(z)) depths.push_back(z);
    }
  }
  if (depths.empty()) return "";
  std::nth_element(depths.begin(), depths.begin() + std::ptrdiff_t(depths.size() / 2), depths.end());
  const float median = depths[depths.size() / 2];
  const double step = step_at(median, is_half), pixels = step * pixels_per_unit(camera, median);
  if (!(pixels > longest_step)) return "";
  return fmt::format(
      "depth: at {:g}, the median, the steps of {} are {:g} units or {:.1f} pixels long, so that surfaces become "
      "stairs; "
      "{}",
      median, is_half ? "half" : "float", step, pixels,
      is_half ? "write depth as 32-bit float" : "place the camera nearer to what it shows");
}

}  // namespace gloam
