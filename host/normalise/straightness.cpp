#include "normalise/straightness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/golden_section.h"

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
/// A pole nearer to 0 than this share of the least value is 0.
constexpr double beside_zero = 0.05;
constexpr long long fewest_each_way = 1;

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

struct Segment {
  int x = 0, y = 0;
  Walk walk;
};

/// About so many segments, all over an image.
std::vector<Segment> segments_of(int width, int height, int length, int most) {
  const double in_all = 2.0 * width * height / (length / 3.0);
  const int apart = std::max(2, int(in_all / most)), next = std::max(1, length / 3);
  std::vector<Segment> segments;
  for (const Walk& walk : {Walk{length, 1, 0}, Walk{length, 0, 1}}) {
    const bool is_row = walk.step_x == 1;
    for (int line = apart / 2; line < (is_row ? height : width); line += apart)
      for (int first = 0; first + length <= (is_row ? width : height); first += next)
        segments.push_back({is_row ? first : line, is_row ? line : first, walk});
  }
  return segments;
}

int length_for(const DepthRows& depth) {
  return std::clamp(std::min(depth.width, depth.height) / 4, shortest_segment, longest_segment);
}

/// Whether all values of a segment are those of surfaces; takes them.
bool take_values(const DepthRows& depth, const Background& background, int x, int y, const Walk& walk, Values& values) {
  for (int i = 0; i < walk.count; ++i) {
    const float value = depth.row(y + i * walk.step_y)[x + i * walk.step_x];
    if (!is_surface(value, background)) return false;
    values[size_t(i)] = double(value);
  }
  return true;
}

/// Whether whole numbers have so few steps in a segment that rounding bends it, and a pole of some value straightens it by chance.
bool are_coarse(const Values& values, int count) {
  constexpr double fewest_steps = 1500;
  const auto is_whole = [](double value) { return value == std::floor(value); };
  if (!std::all_of(values.begin(), values.begin() + count, is_whole)) return false;
  const auto [least, most] = std::minmax_element(values.begin(), values.begin() + count);
  return *most - *least < fewest_steps;
}

/// How far segments bend if distances are proportional to how far a value is from the pole.
double bend_for_pole(const Values& values, int count, double pole) {
  Values inverse;
  for (int i = 0; i < count; ++i) inverse[size_t(i)] = 1 / (values[size_t(i)] - pole);
  return bend_of(inverse, count);
}

double bend_for(const Values& values, int count, double pole) {
  return std::isfinite(pole) ? bend_for_pole(values, count, pole) : bend_of(values, count);
}

/// The pole between two that bends segments least in the middle of them, by golden sections.
double refined(const std::vector<Values>& segments, int count, double first, double last) {
  const auto bend = [&](double pole) {
    std::vector<double> bends;
    for (const Values& values : segments) bends.push_back(bend_for_pole(values, count, pole));
    std::nth_element(bends.begin(), bends.begin() + std::ptrdiff_t(bends.size() / 2), bends.end());
    return bends[bends.size() / 2];
  };
  return least_between(first, last, 30, bend);
}

}  // namespace

std::vector<double> poles_beside(double low, double high, const Poles& poles) {
  std::vector<double> found;
  for (int i = 0; i < poles.on_a_side; ++i) {
    const double away =
        (high - low) * poles.nearest * std::pow(poles.farthest / poles.nearest, i / (poles.on_a_side - 1.0));
    found.push_back(low - away);
    found.push_back(high + away);
  }
  return found;
}

std::optional<LinearGrey> linear_grey_of(const DepthRows& depth, const Background& background) {
  constexpr int most_of_grey = 2000;
  constexpr double ends = 0.005, least_spread = 5, spare = 1e-4;
  const int length = length_for(depth);
  if (depth.width < length || depth.height < length) return {};
  struct Piece {
    Values values;
    bool is_column;
  };
  std::vector<Piece> segments;
  std::vector<double> all;
  for (const Segment& segment : segments_of(depth.width, depth.height, length, most_of_grey)) {
    Values values;
    if (!take_values(depth, background, segment.x, segment.y, segment.walk, values)) continue;
    if (are_coarse(values, length)) continue;
    segments.push_back({values, segment.walk.step_y == 1});
    all.push_back(values.front());
  }
  if ((long long)segments.size() < Straightness::fewest) return {};
  std::sort(all.begin(), all.end());
  const double low = all[size_t(ends * double(all.size()))], high = all[size_t((1 - ends) * double(all.size() - 1))];
  const auto is_between = [&](double value) { return value >= low && value <= high; };
  std::erase_if(segments, [&](const Piece& piece) {
    return !std::all_of(piece.values.begin(), piece.values.begin() + length, is_between);
  });
  if (!(high > low)) return {};
  // The first stands for none, where the values themselves are straight.
  std::vector<double> poles = {std::numeric_limits<double>::infinity()};
  for (const double pole : poles_beside(low, high, {.on_a_side = 28, .nearest = 0.02, .farthest = 30}))
    poles.push_back(pole);
  std::vector<std::vector<double>> bends(segments.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (size_t i = 0; i < segments.size(); ++i)
    for (const double pole : poles) bends[i].push_back(bend_for(segments[i].values, length, pole));
  std::vector<long long> spoken(poles.size(), 0);
  std::vector<size_t> speaking;
  for (size_t i = 0; i < segments.size(); ++i) {
    const auto [least, most] = std::minmax_element(bends[i].begin(), bends[i].end());
    if (!(*least < largest_bend) || !(*most > least_spread * *least)) continue;
    speaking.push_back(i);
    for (size_t p = 0; p < poles.size(); ++p) spoken[p] += bends[i][p] < 2 * *least + spare;
  }
  const size_t best = size_t(std::max_element(spoken.begin(), spoken.end()) - spoken.begin());
  LinearGrey found;
  found.pole = poles[best];
  found.segments = spoken[best], found.all = (long long)speaking.size();
  const bool is_clear =
      found.segments >= Straightness::fewest && double(found.segments) >= least_share * double(found.all);
  if (!is_clear) return {};
  long long in_columns = 0;
  for (const size_t i : speaking) in_columns += bends[i][best] < largest_bend && segments[i].is_column;
  found.is_both_ways = std::min(in_columns, found.segments - in_columns) >= fewest_each_way;
  if (best == 0) return found;
  std::vector<Values> straight;
  for (const size_t i : speaking)
    if (bends[i][best] < largest_bend) straight.push_back(segments[i].values);
  LinearGrey grey = found;
  grey.is_above = poles[best] > high;
  // between its neighbours on the same side
  const double side = grey.is_above ? high : low, nearer = side + (poles[best] - side) / 1.5,
               farther = side + (poles[best] - side) * 1.5;
  grey.pole = refined(straight, length, std::min(nearer, farther), std::max(nearer, farther));
  grey.is_zero = std::abs(grey.pole) < beside_zero * low;
  return grey;
}

bool is_proportional_to_distance(const DepthRows& depth, const Background& background) {
  constexpr int enough = 1000;
  constexpr double least_gain = 2;
  const int length = length_for(depth);
  long long for_zero = 0, all = 0;
  const std::vector<Segment> segments = segments_of(depth.width, depth.height, length, enough);
#pragma omp parallel for schedule(dynamic, 16) reduction(+ : for_zero, all)
  for (size_t i = 0; i < segments.size(); ++i) {
    Values values;
    if (!take_values(depth, background, segments[i].x, segments[i].y, segments[i].walk, values)) continue;
    const double bend = bend_for_pole(values, length, 0);
    if (!(bend < largest_bend)) continue;
    const double low = *std::min_element(values.begin(), values.begin() + length), away = beside_zero * low;
    ++all;
    for_zero += bend_for_pole(values, length, away) > least_gain * bend &&
                bend_for_pole(values, length, -away) > least_gain * bend;
  }
  return double(for_zero) >= least_share * double(all);
}

Straightness::Meaning Straightness::meaning() const {
  for (const Meaning meaning : {planar, along_ray, of_inverse})
    if (of(meaning) >= fewest && double(of(meaning)) >= least_share * double(all())) return meaning;
  return unknown;
}

bool Straightness::is_of_inverse_both_ways() const {
  return std::min(of_inverse_in_columns, of(of_inverse) - of_inverse_in_columns) >= fewest_each_way;
}

Straightness straightness_of(const DepthRows& depth, float sign, const Background& background, const Window& window,
                             const Camera& camera) {
  Straightness found;
  const int length = length_for(depth);
  if (camera.orthographic || camera.slits || depth.width < length || depth.height < length) return found;
  const std::vector<Segment> segments = segments_of(depth.width, depth.height, length, most_segments);
  long long planar = 0, along_ray = 0, of_inverse = 0, in_columns = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(+ : planar, along_ray, of_inverse, in_columns)
  for (size_t i = 0; i < segments.size(); ++i) {
    const Straightness::Meaning meaning =
        meaning_of(depth, sign, background, window, camera, segments[i].x, segments[i].y, segments[i].walk);
    planar += meaning == Straightness::planar;
    along_ray += meaning == Straightness::along_ray;
    of_inverse += meaning == Straightness::of_inverse;
    in_columns += meaning == Straightness::of_inverse && segments[i].walk.step_y == 1;
  }
  found.segments[Straightness::planar] = planar;
  found.segments[Straightness::along_ray] = along_ray;
  found.segments[Straightness::of_inverse] = of_inverse;
  found.of_inverse_in_columns = in_columns;
  return found;
}

}  // namespace gloam
