#include "normalise/told_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/statistics.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/straightness.h"

namespace gloam {
namespace {

/// A depth that is read, and what was found of it.
struct Untold {
  const Channel& depth;
  const StoredDepth& found;
  const Camera& camera;
  const StatedDepth& stated;
};

constexpr const char* by_planes = "by which plane surfaces are plane";

std::string pieces(long long segments, long long all) {
  return fmt::format("{} of {} straight pieces of rows and columns", segments, all);
}

std::string says_otherwise() { return option("depth", "z") + " says otherwise"; }

/// Of some thousand pixels.
double median_of_surfaces(const Channel& depth, const Background& background) {
  const Layout& layout = depth.layout();
  const int apart = std::max(1, int(std::sqrt(double(layout.width) * layout.height / 4096)));
  std::vector<double> values;
  for (int y = 0; y < layout.height; y += apart)
    for (int x = 0; x < layout.width; x += apart)
      if (is_surface(depth.at(x, y), background)) values.push_back(double(depth.at(x, y)));
  return values.empty() ? 0 : median(std::move(values));
}

StatedDepth read_as(const StatedDepth& stated, DepthConvention convention) {
  StatedDepth read = stated;
  read.convention = convention;
  return read;
}

/// What is told, of a frame of a shot or where something that it needs is not known: planar distance is taken, and the note names the flags.
StatedDepth only_told(const Untold& untold, const std::string& what, const std::string& why, const std::string& flags,
                      std::vector<std::string>& assumed) {
  assumed.push_back(fmt::format(
      "depth: taken as planar distance along the viewing axis, though plane surfaces are plane if it is {} ({}); {}",
      what, why, flags));
  return read_as(untold.stated, DepthConvention::z);
}

StatedDepth along_rays(const Untold& untold, const Straightness& straightness, std::vector<std::string>& assumed) {
  const std::string why = pieces(straightness.of(Straightness::along_ray), straightness.all());
  if (untold.stated.is_of_shot)
    return only_told(untold, "the distance along the ray", why, option("depth", "ray") + " reads a whole shot so",
                     assumed);
  assumed.push_back(
      fmt::format("depth: taken as the distance along the ray, {} ({}); {}", by_planes, why, says_otherwise()));
  return read_as(untold.stated, DepthConvention::ray);
}

/// 1/z is a linear function of what is stored: normalised device depth where all of it lies in 0 to 1, else disparities.
StatedDepth linear_in_inverse(const Untold& untold, bool is_both_ways, const std::string& why,
                              std::vector<std::string>& assumed) {
  const StatedDepth& stated = untold.stated;
  const bool is_window_depth = untold.found.is_in_unit_interval;
  const bool is_reversed = median_of_surfaces(untold.depth, untold.found.background) < 0.5;
  const bool is_near_known = stated.near || untold.camera.near, is_far_known = stated.far || untold.camera.far;
  if (is_window_depth && !is_reversed && !(is_near_known && is_far_known))
    return only_told(untold, "normalised device depth", why,
                     fmt::format("{} with {} and {} reads it", option("depth", "ndc"), option("near"), option("far")),
                     assumed);
  if (stated.is_of_shot || stated.scale || !is_both_ways)
    return only_told(untold, is_window_depth ? "normalised device depth" : "a disparity", why,
                     option("depth", is_window_depth ? (is_reversed ? "reversed" : "ndc") : "inverse") + " reads it so",
                     assumed);
  if (!is_window_depth) {
    assumed.push_back(fmt::format("depth: taken as inverse, {} ({}); {}", by_planes, why, says_otherwise()));
    return read_as(stated, DepthConvention::inverse);
  }
  StatedDepth read = read_as(stated, is_reversed ? DepthConvention::reversed : DepthConvention::ndc);
  if (!is_near_known) read.near = 1;
  assumed.push_back(fmt::format(
      "depth: taken as {}normalised device depth, {} ({}){}; {}", is_reversed ? "reversed " : "", by_planes, why,
      is_near_known ? "" : fmt::format("; lengths are in units of the near plane, which {} gives", option("near")),
      says_otherwise()));
  return read;
}

/// Proportional to the distance from a value that is not 0.
StatedDepth of_grey(const Untold& untold, const LinearGrey& grey, std::vector<std::string>& assumed) {
  const bool is_white_near = grey.is_above;
  const double scale = is_white_near ? -1 : 1, offset = is_white_near ? grey.pole : -grey.pole;
  const std::string why = pieces(grey.segments, grey.all);
  const std::string flags = fmt::format("{} {}", option("depth-scale", fmt::format("{:g}", scale)),
                                        option("depth-offset", fmt::format("{:.6g}", offset)));
  const std::string what =
      fmt::format("a grey that is linear in the distance, {} near", is_white_near ? "white" : "black");
  if (untold.stated.is_of_shot || untold.stated.scale)
    return only_told(untold, what, why, flags + " reads it so", assumed);
  assumed.push_back(fmt::format("depth: taken as {}, {} ({}): {}; lengths are in units of what is stored; {}", what,
                                by_planes, why, flags, says_otherwise()));
  StatedDepth read = read_as(untold.stated, DepthConvention::z);
  read.scale = scale;
  read.offset = offset;
  return read;
}

}  // namespace

StatedDepth told_by_planes(const Channel& depth, const StoredDepth& found, const Window& window, const Camera& camera,
                           const StatedDepth& stated, std::vector<std::string>& assumed) {
  const Untold untold{depth, found, camera, stated};
  const DepthRows rows = rows_of(depth);
  const Straightness straightness = straightness_of(rows, found.sign, found.background, window, camera);
  if (straightness.meaning() == Straightness::along_ray) return along_rays(untold, straightness, assumed);
  const bool may_be_grey = found.sign > 0 && !camera.orthographic && !camera.slits &&
                           (found.is_in_unit_interval || straightness.meaning() != Straightness::of_inverse);
  const bool is_proportional =
      straightness.meaning() == Straightness::planar && is_proportional_to_distance(rows, found.background);
  if (may_be_grey && !is_proportional) {
    const std::optional<LinearGrey> grey = linear_grey_of(rows, found.background);
    if (grey && std::isinf(grey->pole))
      return linear_in_inverse(untold, grey->is_both_ways, pieces(grey->segments, grey->all), assumed);
    if (grey && !grey->is_zero) return of_grey(untold, *grey, assumed);
  }
  if (straightness.meaning() == Straightness::of_inverse && found.sign > 0) {
    return linear_in_inverse(untold, straightness.is_of_inverse_both_ways(),
                             pieces(straightness.of(Straightness::of_inverse), straightness.all()), assumed);
  }
  if (found.sign < 0) return read_as(stated, DepthConvention::z);  // which another note tells
  if (straightness.meaning() == Straightness::planar)
    assumed.push_back(fmt::format("depth: taken as planar distance along the viewing axis, {}; {} says otherwise",
                                  by_planes, option("depth")));
  else
    assumed.push_back(note_on_planar_depth(found.is_in_unit_interval));
  return read_as(stated, DepthConvention::z);
}

}  // namespace gloam
