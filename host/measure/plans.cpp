#include "measure/plans.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/history.h"
#include "gloam/planes.h"
#include "gloam/variants.h"
#include "measure/effects.h"
#include "shared/sampling/ambient_occlusion.h"

namespace gloam::bench {

PlanRequest request_for(const Variation& variation) {
  PlanRequest request{
      .outputs = {variation.technique->name}, .preset = variation.preset, .resolution = variation.resolution};
  if (ParameterValues(variation.technique->parameters).has("radius"))
    // In the shortest form that reads back as the same float.
    request.settings.emplace_back("radius", fmt::format("{}", float(variation.radius)));
  request.radius = variation.radius;  // of others: the technique that makes what this one reads
  request.settings.insert(request.settings.end(), variation.settings.begin(), variation.settings.end());
  request.temporal = variation.temporal;
  return request;
}

PlanOption option_of(const Variation& variation) { return {request_for(variation)}; }

RunOptions Variation::run_options() const {
  RunOptions options;
  options.math = math;
  options.real = real;
  return options;
}

bool is_filter(const Technique& technique) {
  const std::string plane = measured_plane(technique);
  return std::any_of(registry().begin(), registry().end(), [&](const Technique& other) {
    return &other != &technique && contains(outputs_of(other), plane) && reads_from(technique, other);
  });
}

std::string own_plane(const Technique& technique) {
  const std::string measured = measured_plane(technique);
  if (technique.then.empty() || contains(technique.writes, measured)) return measured;
  const Technique& filter = find_technique(technique.then);
  for (const std::string& plane : technique.writes) {
    if (contains(filter.reads, plane)) return plane;
  }
  return measured;
}

std::vector<std::string> depths_of(const Technique& technique) {
  std::vector<std::string> depths;
  for (const std::string& plane : technique.reads) {
    if (plane_kind(plane).meaning == PlaneKind::view_depth) depths.push_back(plane);
  }
  return depths;
}

bool reads_layers(const Technique& technique) {
  return std::any_of(technique.reads.begin(), technique.reads.end(),
                     [](const std::string& plane) { return is_stack(plane); });
}

bool any_makes_first_view_only(const std::vector<const Technique*>& techniques) {
  return std::any_of(techniques.begin(), techniques.end(),
                     [](const Technique* t) { return makes_first_view_only(*t); });
}

const Technique* over_all_layers(const Technique& technique) {
  if (contains(technique.reads, "peel")) return &technique;
  const Variant is = variant_of(technique);  // "sd-hbao+", too, is "dp-hbao+" over all layers
  return is.both_eyes ? nullptr : find_variant({is.of, Layers::peeled});
}

Settings settings_over_other_layers(const Settings& settings, const Technique& from, const Technique& to) {
  if (&from == &to) return settings;
  const ParameterValues known(to.parameters), of_layers(StochasticParams::table());
  const bool has_own_layers = contains(from.reads, "stochastic");
  Settings same;
  for (const auto& setting : settings) {
    if (known.has(setting.first) && !(has_own_layers && of_layers.has(setting.first))) same.push_back(setting);
  }
  return same;
}

std::vector<std::string> planes_of(const Frame& frame) {
  std::vector<std::string> names;
  for (const auto& [name, plane] : frame.views.front().planes) {
    const bool everywhere = std::all_of(frame.views.begin(), frame.views.end(),
                                        [&, &wanted = name](const View& view) { return view.find(wanted); });
    if (everywhere) names.push_back(name);
  }
  return names;
}

Plan whole_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds) {
  PlanRequest request = request_for(variation);
  request.only_outputs = {measured_plane(*variation.technique)};
  if (!variation.temporal) return make_plan(request, available, holds);
  check_temporal(request);
  for (const std::string& plane : planes_for_history()) {
    if (contains(outputs_of(*variation.technique), plane)) add_new(request.only_outputs, plane);
  }
  std::vector<std::string> with_history = available;
  with_history.insert(with_history.end(), history_planes().begin(), history_planes().end());
  return make_plan(request, with_history, holds);
}

Plan unfiltered_plan(const Variation& variation, const std::vector<std::string>& available, const std::string& holds,
                     const Settings& more) {
  PlanRequest request = request_for(variation);
  request.only_outputs = {own_plane(*variation.technique)};
  request.filter = "none";
  request.settings.insert(request.settings.end(), more.begin(), more.end());
  return make_plan(request, available, holds);
}

Plan filter_of(const Plan& whole, const Technique& technique) {
  Plan plan = whole;
  const auto own = [&](const PlannedPass& planned) { return planned.technique == &technique; };
  const auto last = std::find_if(plan.passes.rbegin(), plan.passes.rend(), own);
  plan.passes.erase(plan.passes.begin(), last.base());
  plan.inputs.clear();
  std::vector<std::string> made;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& binding : planned.pass.reads) {
      if (!contains(made, binding.plane)) add_new(plan.inputs, binding.plane);
    }
    for (const Binding& binding : planned.pass.writes) made.push_back(binding.plane);
  }
  return plan;
}

const ParameterValues* values_of(const Plan& plan, const std::string& technique) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.technique->name == technique) return &planned.values;
  }
  return nullptr;
}

}  // namespace gloam::bench
