#include "normalise/straightness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gloam {
namespace {

constexpr int longest_segment = 64, shortest_segment = 24;
/// Segments looked at, about: enough for a few planes to be found, and a few milliseconds at most.
constexpr int most_segments = 6000;
/// Bends are root mean squares off a straight line over those of the line itself. A segment counts if its least bend is below the
/// first, and all others are so much larger. Of surfaces that are not plane, few are straight to that by chance.
constexpr double largest_bend = 0.01, least_ratio = 3;
constexpr double least_share = 0.8;
constexpr double least_variation = 0.5;

using Values = std::array<double, longest_segment>;

/// How far values are from a straight line.
double bend_of(const Values& values, int count) {
  double mean = 0;
  for (int i = 0; i < count; ++i) mean += values[size_t(i)];
  mean /= count;
  const double middle = 0.5 * (count - 1), squares = count * (double(count) * count - 1) / 12;
  double along = 0, all = 0;
  for (int i = 0; i < count; ++i) {
    const double value = values[size_t(i)] - mean;
    along += value * (i - middle);
    all += value * value;
  }
  const double line = along * along / squares;
  return line > 0 ? std::sqrt(std::max(all - line, 0.0) / line) : std::numeric_limits<double>::infinity();
}

double relative_range(const Values& values, int count) {
  const auto [least, most] = std::minmax_element(values.begin(), values.begin() + count);
  return (*most - *least) / *most;
}

/// Segments that begin at some pixels and run along rows or columns.
struct Walk {
  int count = 0, step_x = 0, step_y = 0;
};

/// The meaning that one segment speaks for.
Straightness::Meaning meaning_of(const DepthRows& depth, float sign, const Background& background, const Window& window,
                                 const Camera& camera, int x, int y, const Walk& walk) {
  Values inverse, of_ray, stored, secant;
  for (int i = 0; i < walk.count; ++i) {
    const int u = x + i * walk.step_x, v = y + i * walk.step_y;
    const float value = sign * depth.row(v)[u];
    if (!is_surface(value, background)) return Straightness::unknown;
    const double tangent_x = (window.x0 + u + 0.5 - camera.cx) / camera.fx,
                 tangent_y = (window.y0 + v + 0.5 - camera.cy) / camera.fy;
    const size_t at = size_t(i);
    stored[at] = double(value);
    inverse[at] = 1 / stored[at];
    secant[at] = std::sqrt(1 + tangent_x * tangent_x + tangent_y * tangent_y);
    of_ray[at] = inverse[at] * secant[at];
  }
  const double bends[] = {std::numeric_limits<double>::infinity(), bend_of(inverse, walk.count),
                          bend_of(of_ray, walk.count), bend_of(stored, walk.count)};
  const auto least = std::min_element(std::begin(bends), std::end(bends));
  if (!(*least < largest_bend)) return Straightness::unknown;
  for (const double& bend : bends)
    if (&bend != least && !(bend > least_ratio * *least)) return Straightness::unknown;
  const auto meaning = Straightness::Meaning(least - std::begin(bends));
  // Values that hardly vary, as normalised device depth far away, leave the secant alone, which is nearly straight by itself.
  const bool tells_little = relative_range(stored, walk.count) < least_variation * relative_range(secant, walk.count);
  return meaning == Straightness::along_ray && tells_little ? Straightness::unknown : meaning;
}

}  // namespace

Straightness::Meaning Straightness::meaning() const {
  for (const Meaning meaning : {planar, along_ray, of_inverse})
    if (of(meaning) >= fewest && double(of(meaning)) >= least_share * double(all())) return meaning;
  return unknown;
}

Straightness straightness_of(const DepthRows& depth, float sign, const Background& background, const Window& window,
                             const Camera& camera) {
  Straightness found;
  const int length = std::clamp(std::min(depth.width, depth.height) / 4, shortest_segment, longest_segment);
  if (camera.orthographic || camera.slits || depth.width < length || depth.height < length) return found;
  const double in_all = 2.0 * depth.width * depth.height / (length / 3.0);
  const int apart = std::max(2, int(in_all / most_segments)), next = std::max(1, length / 3);
  for (const Walk& walk : {Walk{length, 1, 0}, Walk{length, 0, 1}}) {
    const bool is_row = walk.step_x == 1;
    for (int line = apart / 2; line < (is_row ? depth.height : depth.width); line += apart) {
      for (int first = 0; first + length <= (is_row ? depth.width : depth.height); first += next)
        ++found.segments[meaning_of(depth, sign, background, window, camera, is_row ? first : line,
                                    is_row ? line : first, walk)];
    }
  }
  return found;
}

}  // namespace gloam
