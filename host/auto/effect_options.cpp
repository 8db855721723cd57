#include "auto/effect_options.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/composition.h"
#include "plan/resample.h"

namespace gloam {
namespace {

const Technique& measured_like(const Technique& technique) {
  const std::string& refined = technique.effect.refines;
  return refined.empty() ? technique : find_technique(refined);
}

std::vector<std::string> presets_of(const Technique& technique, const PlanRequest& asked) {
  if (!asked.preset.empty()) return {asked.preset};
  std::vector<std::string> names;
  for (const Preset& preset : technique.presets) names.push_back(preset.name);
  return names;
}

std::vector<int> resolutions_of(const PlanRequest& asked) {
  return asked.resolution > 1 ? std::vector{asked.resolution} : std::vector{1, 2, 4};
}

/// The effect's technique alone, and with each technique that completes it.
std::vector<std::vector<std::string>> combinations_of(const Technique& technique) {
  std::vector<std::vector<std::string>> combinations = {{technique.name}};
  for (const Technique* more : techniques_that_complete(measured_like(technique)))
    combinations.push_back({technique.name, more->name});
  return combinations;
}

std::vector<std::string> parts_among(const std::vector<std::string>& planes) {
  std::vector<std::string> parts;
  for (const std::string& plane : part_planes())
    if (contains(planes, plane)) parts.push_back(plane);
  return parts;
}

/// Leaves out settings that the option's plan does not have, and names its planes. False: the frame does not allow it.
bool complete(EffectOption& option, const Technique& technique, const EffectProbe& probe) {
  try {
    option.request = with_known_settings(technique, option.request, probe.available, probe.holds);
    option.makes = parts_among(make_plan(option.request, probe.available, probe.holds).outputs);
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool is_as_seen(const EffectOption& option, const Technique& technique, const SeenEffect& seen,
                const EffectProbe& probe) {
  const PlanRequest& request = option.request;
  if (&technique != seen.technique || request.preset != seen.preset || request.resolution != seen.step) return false;
  if (seen.step == 1 || !request.adaptive.empty()) return false;
  const Plan plan = make_plan(request, probe.available, probe.holds);
  const auto is_seen = [&](const std::string& plane) { return contains(seen.planes, plane); };
  // What is made of all pixels, such as normals of depth, differs from what the look makes of its few.
  const auto is_of_few = [](const PlannedPass& planned) {
    return planned.technique == &resampling() || planned.scale > 1;
  };
  return std::all_of(plan.outputs.begin(), plan.outputs.end(), is_seen) &&
         std::all_of(plan.passes.begin(), plan.passes.end(), is_of_few) && upsampling_of(plan);
}

}  // namespace

std::vector<UsedPlane> EffectOption::planes_on(const SeenChanges& seen) const {
  std::vector<UsedPlane> planes;
  for (const std::string& plane : makes) planes.push_back(plane_by(plane, request.preset, request.resolution, seen));
  return planes;
}

std::vector<EffectOption> options_of(const Technique& technique, const EffectProbe& probe, const SeenEffect& seen) {
  std::vector<EffectOption> options;
  for (const std::vector<std::string>& techniques : combinations_of(technique)) {
    for (const std::string& preset : presets_of(technique, probe.asked)) {
      for (const int resolution : resolutions_of(probe.asked)) {
        EffectOption option{{request_everywhere(technique, probe.asked)}};
        option.request.outputs = techniques;
        option.request.preset = preset;
        option.request.resolution = resolution;
        if (!complete(option, technique, probe)) continue;
        option.is_seen = is_as_seen(option, technique, seen, probe);
        options.push_back(std::move(option));
      }
    }
  }
  return options;
}

}  // namespace gloam
