#include "technique/ambient_occlusion.h"

#include "gloam/planes.h"

namespace gloam {
namespace {

Pass bilateral_pass(const std::string& name, const std::string& from, const std::string& to, int columns, int rows) {
  const int components = int(plane_kind(to).components.size());
  return {.name = name,
          .kernel = "bilateral",
          .reads = {{"source", from}, "depth", "normal"},
          .writes = {{"result", to}},
          .defines = {{"COLUMNS", columns}, {"ROWS", rows}, {"COMPONENTS", components}},
          .footprint = {.columns = columns, .rows = rows},
          .can_skip = true};
}

}  // namespace

std::vector<Pass> bilateral_passes(int half_width, bool is_square, const std::string& source,
                                   const std::string& result) {
  if (is_square) return {bilateral_pass("square", source, result, half_width, half_width)};
  const std::string between = result + "@across";
  return {bilateral_pass("horizontal", source, between, half_width, 0),
          bilateral_pass("vertical", between, result, 0, half_width)};
}

Technique ambient_occlusion(std::string name, std::string summary, std::string paper, std::string source) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .paper = std::move(paper),
          .source = std::move(source),
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .outputs = {"ao", "ao_raw"},
          .then = "bilateral",
          .then_with = {{"half_width", "2"}}};
}

std::vector<Preset> presets_of_samples() {
  return {{"low", {{"samples", "8"}}},
          {"medium", {{"samples", "18"}}},
          {"high", {{"samples", "36"}}},
          {"ultra", {{"samples", "72"}}}};
}

int value_of_samples(const ParameterValues& values) { return int(values.number("samples")); }

int directions_times_steps(const ParameterValues& values) {
  return int(values.number("directions") * values.number("steps"));
}

Technique over_slices(Technique technique) {
  technique.presets = {{"low", {{"directions", "1"}, {"steps", "4"}}},
                       {"medium", {{"directions", "1"}, {"steps", "9"}}},
                       {"high", {{"directions", "1"}, {"steps", "18"}}},
                       {"ultra", {{"directions", "4"}, {"steps", "18"}}}};
  technique.converged = {{"directions", "32"}, {"steps", "64"}};
  technique.samples = [](const ParameterValues& values) { return 2 * directions_times_steps(values); };
  return technique;
}

Technique over_peeled_layers(Technique technique) {
  technique.variant = {technique.name, Layers::peeled};
  technique.summary = technique.name + " over all peeled depth layers: the upper bound of what more layers can give";
  technique.name.insert(0, peeled_prefix);
  technique.paper += "; over layers Vermeer, Scandolo, Eisemann 2021";
  technique.default_for.clear();
  technique.may_read.clear();
  technique.effect = {};
  technique.reads.push_back("peel");
  technique.passes = [over_depth = technique.passes](const ParameterValues& values) {
    std::vector<Pass> passes = over_depth(values);
    for (Pass& pass : passes) {
      if (pass.name == "estimate") pass.reads.push_back({"occluders", "peel"});
    }
    return passes;
  };
  return technique;
}

std::vector<Pass> behind_depth(Pass estimate, int samples) {
  const Binding hidden("hidden_depths", "hidden_depths", samples);
  Pass sort{.name = "sort",
            .kernel = "sort_hidden_depths",
            .reads = {"depth", {"stochastic", "stochastic", samples}},
            .writes = {hidden}};
  estimate.reads.push_back({"occluders", hidden.plane, hidden.layers});
  estimate.defines.insert(estimate.defines.end(), {{"STOCHASTIC", 1}, {"OCCLUDERS_LAYERS", samples}});
  sort.defines = estimate.defines;
  return {std::move(sort), std::move(estimate)};
}

Pass at_lower_resolution(Pass sort, int scale) {
  sort.name = "sort at 1/" + std::to_string(scale);
  sort.kernel = "sort_every_hidden_depths";
  sort.scale = scale;
  sort.defines.emplace_back("SCALE", scale);
  Binding& hidden = sort.writes.front();
  hidden.plane += "@low";
  hidden.as_launched = true;
  sort.writes.insert(sort.writes.begin(), Binding("low_depth", "depth@low"));
  return sort;
}

Technique over_stochastic_depth(Technique technique, ParameterList parameters,
                                std::function<std::vector<Pass>(const ParameterValues&)> passes) {
  technique.variant = {technique.name, Layers::stochastic};
  technique.summary = technique.name + " with stochastic depths behind what is seen";
  technique.name.insert(0, stochastic_prefix);
  technique.paper += "; over stochastic depth Vermeer, Scandolo, Eisemann 2021";
  technique.default_for.clear();
  technique.may_read.clear();
  technique.effect = {};
  technique.reads.push_back("stochastic");
  technique.parameters = std::move(parameters);
  technique.passes = std::move(passes);
  return technique;
}

Technique with_points(Technique technique) {
  const auto rename = [](Settings& settings) {
    for (auto& [name, value] : settings) {
      if (name == "samples") name = "points";
    }
  };
  for (Preset& preset : technique.presets) rename(preset.settings);
  rename(technique.converged);
  technique.samples = [](const ParameterValues& values) { return int(values.number("points")); };
  return technique;
}

}  // namespace gloam
