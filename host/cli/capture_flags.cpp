#include "cli/capture_flags.h"

#include <algorithm>
#include <limits>

#include "gloam/error.h"

namespace gloam::cli {

std::vector<std::string> planes_of(const CaptureCommand& flags) {
  std::vector<std::string> planes;
  if (!flags.planes.empty()) planes = split_list(flags.planes, "--planes");
  for (const std::string& plane : capture_planes()) {
    if (flags.planes.empty() && plane != "motion") planes.push_back(plane);
  }
  if (contains(planes, "motion") && flags.path.empty())
    throw UsageError("--planes motion needs cameras of two moments; give --camera-path FILE.json");
  if (!flags.path.empty()) add_new(planes, "motion");
  return planes;
}

StochasticOptions stochastic_of(const CaptureCommand& flags) {
  StochasticOptions options;
  if (flags.stochastic.empty()) {
    if (!flags.alpha.empty()) throw UsageError("--alpha is of a stochastic depth map; give --stochastic S too");
    if (!flags.stochastic_seed.empty())
      throw UsageError("--stochastic-seed is of a stochastic depth map; give --stochastic S too");
    return options;
  }
  options.samples = parse_whole_number(flags.stochastic, "--stochastic", 1, 16);
  if (!flags.alpha.empty()) options.alpha = parse_number(flags.alpha, "--alpha", 0, 1);
  if (!flags.stochastic_seed.empty())
    options.seed = parse_whole_number(flags.stochastic_seed, "--stochastic-seed", 0, std::numeric_limits<int>::max());
  return options;
}

std::optional<OutlineOptions> outlines_of(const CaptureCommand& flags) {
  if (flags.outlines.empty()) {
    if (!flags.outline_method.empty()) throw UsageError("--outline-method is of outlines; give --outlines EXTENT too");
    if (!flags.outline_angle.empty()) throw UsageError("--outline-angle is of outlines; give --outlines EXTENT too");
    return {};
  }
  OutlineOptions options;
  options.extent = parse_number(flags.outlines, "--outlines", 1e-15, 1e15);
  if (!flags.outline_method.empty()) {
    const std::vector<std::string>& names = outline_methods();
    const auto found = std::find(names.begin(), names.end(), flags.outline_method);
    if (found == names.end())
      throw UsageError("--outline-method {} is not allowed{}; {} are", flags.outline_method,
                       suggestion(flags.outline_method, names), enumerate(names));
    options.method = OutlineMethod(found - names.begin());
  }
  if (flags.outline_angle.empty()) return options;
  if (options.method != OutlineMethod::integrated)
    throw UsageError(
        "--outline-angle tells apart the normals that --outline-method integrated takes the mean of; leave it out");
  options.angle_degrees = parse_number(flags.outline_angle, "--outline-angle", 0, 90);
  return options;
}

std::optional<double> second_view_of(const CaptureCommand& flags) {
  if (flags.view2.empty()) return {};
  const double degrees = parse_number(flags.view2, "--view2", -90, 90);
  if (degrees == 0) throw UsageError("--view2 0 would be the first view again; give -90 to 90 degrees, but not 0");
  return degrees;
}

std::optional<StereoRig> stereo_of(const CaptureCommand& flags) {
  if (flags.stereo.empty()) {
    if (!flags.convergence.empty()) throw UsageError("--convergence is of two eyes; give --stereo IPD too");
    if (flags.toe_in) throw UsageError("--toe-in is of two eyes; give --stereo IPD and --convergence D too");
    return {};
  }
  StereoRig rig{parse_number(flags.stereo, "--stereo", 0, 1e30), {}, flags.toe_in};
  if (!flags.convergence.empty()) rig.convergence = parse_number(flags.convergence, "--convergence", 1e-30, 1e30);
  if (flags.toe_in && !rig.convergence)
    throw UsageError("--toe-in turns the eyes towards a depth; give --convergence D too");
  return rig;
}

void check_second_view_flags(const CaptureCommand& flags) {
  std::vector<std::string> given;
  if (!flags.view2.empty()) given.push_back("--view2");
  if (!flags.stereo.empty()) given.push_back("--stereo");
  if (!flags.path.empty()) given.push_back("--camera-path");
  if (!flags.display.empty()) given.push_back("--display");
  if (given.size() > 1)
    throw UsageError("{} cannot be given together, as each says which views a frame has; give one of them",
                     enumerate(given));
}

}  // namespace gloam::cli
