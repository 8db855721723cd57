#include "cli/capture/flags.h"

#include <algorithm>
#include <tuple>

#include "gloam/error.h"

namespace gloam::cli {

std::vector<std::string> planes_of(const CaptureCommand& flags) {
  std::vector<std::string> planes =
      flags.planes.empty() ? usual_capture_planes() : split_list(flags.planes, "--planes");
  const bool moves = !flags.moving().empty();
  if (contains(planes, "motion") && !moves)
    throw UsageError("--planes motion needs cameras of two moments; give --camera-path FILE.json or --shot NAME");
  if (moves) add_new(planes, "motion");
  return planes;
}

StochasticOptions stochastic_of(const CaptureCommand& flags) {
  StochasticOptions options;
  options.subset = flags.stochastic_subset.value_or(options.subset);
  options.surfaces = flags.stochastic_surfaces.value_or(options.surfaces);
  const std::string lacks_chance = options.subset != StochasticSubset::nearest
                                       ? ""
                                       : "surfaces chosen at random; give --stochastic-subset stratified too",
                    lacks_radius = options.surfaces == StochasticSurfaces::relevant
                                       ? ""
                                       : "surfaces within a radius; give --stochastic-surfaces relevant too";
  for (const auto& [flag, is_given, lacks] :
       {std::tuple("--stochastic-surfaces", flags.stochastic_surfaces.has_value(), std::string()),
        std::tuple("--stochastic-subset", flags.stochastic_subset.has_value(), std::string()),
        std::tuple("--alpha", flags.alpha.has_value(), lacks_chance),
        std::tuple("--stochastic-seed", flags.stochastic_seed.has_value(), lacks_chance),
        std::tuple("--stochastic-radius", flags.stochastic_radius.has_value(), lacks_radius),
        std::tuple("--stochastic-reach", flags.stochastic_reach.has_value(), lacks_radius)}) {
    if (!is_given) continue;
    if (!flags.stochastic) throw UsageError("{} is for a stochastic depth map; give --stochastic S too", flag);
    if (!lacks.empty()) throw UsageError("{} is for {}", flag, lacks);
  }
  options.samples = flags.stochastic.value_or(0);
  options.alpha = flags.alpha.value_or(options.alpha);
  options.seed = flags.stochastic_seed.value_or(options.seed);
  options.radius = flags.stochastic_radius;
  options.max_reach = flags.stochastic_reach.value_or(options.max_reach);
  return options;
}

std::optional<OutlineOptions> outlines_of(const CaptureCommand& flags) {
  if (!flags.outlines) {
    if (flags.outline_method) throw UsageError("--outline-method is for outlines; give --outlines EXTENT too");
    if (flags.outline_angle) throw UsageError("--outline-angle is for outlines; give --outlines EXTENT too");
    return {};
  }
  OutlineOptions options;
  options.extent = *flags.outlines;
  options.method = flags.outline_method.value_or(options.method);
  if (!flags.outline_angle) return options;
  if (!has_angle(options.method))
    throw UsageError(
        "--outline-angle tells apart the normals that --outline-method mitre and integrated take the mean of; leave it "
        "out");
  options.angle_degrees = *flags.outline_angle;
  return options;
}

std::optional<double> second_view_of(const CaptureCommand& flags) {
  if (flags.view2 == 0.0)
    throw UsageError("--view2 0 would be the first view again; give -90 to 90 degrees, but not 0");
  return flags.view2;
}

std::optional<StereoRig> stereo_of(const CaptureCommand& flags) {
  if (!flags.stereo) {
    if (flags.convergence) throw UsageError("--convergence is for two eyes; give --stereo IPD too");
    if (flags.toe_in) throw UsageError("--toe-in is for two eyes; give --stereo IPD and --convergence D too");
    return {};
  }
  const StereoRig rig{*flags.stereo, flags.convergence, flags.toe_in};
  if (flags.toe_in && !rig.convergence)
    throw UsageError("--toe-in turns the eyes towards a depth; give --convergence D too");
  return rig;
}

void check_second_view_flags(const CaptureCommand& flags) {
  std::vector<std::string> given;
  if (flags.view2) given.push_back("--view2");
  if (flags.stereo) given.push_back("--stereo");
  if (!flags.display.empty()) given.push_back("--display");
  if (given.size() > 1)
    throw UsageError("{} cannot be given together, as each says which views a frame has; give one of them",
                     enumerate(given));
  if (flags.view2 && !flags.moving().empty())
    throw UsageError(
        "--view2 and {} cannot be given together: the second view turns about what the first one shows in each frame, "
        "so "
        "it has no motion; give one of them, or --stereo IPD for two eyes that move",
        flags.moving());
}

}  // namespace gloam::cli
