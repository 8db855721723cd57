#include "technique/ambient_occlusion.h"

#include <algorithm>

#include "gloam/planes.h"
#include "shared/sampling/ambient_occlusion.h"

namespace gloam {
namespace {

/// Wider filters keep too many rows for a GPU's registers.
constexpr int widest_in_one_pass = 4;

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

/// Renames a technique's parameter `samples`, if it has one.
void call_samples_points(Technique& technique) {
  if (!ParameterValues(technique.parameters).has("samples")) return;
  const auto rename = [](std::string& name) {
    if (name == "samples") name = "points";
  };
  for (Parameter& parameter : technique.parameters) rename(parameter.name);
  for (Preset& preset : technique.presets) {
    for (auto& setting : preset.settings) rename(setting.first);
  }
  for (auto& setting : technique.converged) rename(setting.first);
  technique.samples = [](const ParameterValues& values) { return int(values.number("points")); };
}

}  // namespace

std::vector<Pass> bilateral_passes_along_axes(int half_width, const std::string& source, const std::string& result) {
  const std::string between = result + "@across";
  return {bilateral_pass("horizontal", source, between, half_width, 0),
          bilateral_pass("vertical", between, result, 0, half_width)};
}

std::vector<Pass> bilateral_passes(int half_width, bool is_square, const std::string& source,
                                   const std::string& result) {
  if (is_square) return {bilateral_pass("square", source, result, half_width, half_width)};
  if (half_width > widest_in_one_pass) return bilateral_passes_along_axes(half_width, source, result);
  Pass both = bilateral_pass("separable", source, result, half_width, half_width);
  both.kernel = "bilateral_separable";
  both.defines.emplace_back("SEPARABLE", 1);
  both.goes_down = true;
  return {both};
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

std::vector<Pass> behind_depth(std::vector<Pass> passes, const StochasticParams& p) {
  const Binding hidden("hidden_depths", "hidden_depths", p.samples);
  const auto estimate =
      std::find_if(passes.begin(), passes.end(), [](const Pass& pass) { return pass.name == "estimate"; });
  estimate->reads.push_back({"occluders", hidden.plane, hidden.layers});
  estimate->defines.insert(estimate->defines.end(), {{"EARLY_OUT", p.early_out},
                                                     {"COMPENSATED", p.compensation != 1},
                                                     {"STOCHASTIC", 1},
                                                     {"OCCLUDERS_LAYERS", p.samples}});
  Pass sort{.name = "sort",
            .kernel = "sort_hidden_depths",
            .reads = {"depth", {"stochastic", "stochastic", p.samples}},
            .writes = {hidden},
            .defines = estimate->defines};
  passes.insert(estimate, std::move(sort));
  return passes;
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

Technique over_stochastic_depth(Technique technique) {
  technique.variant = {technique.name, Layers::stochastic};
  technique.summary = technique.name + " with stochastic depths behind what is seen";
  technique.name.insert(0, stochastic_prefix);
  technique.paper += "; over stochastic depth Vermeer, Scandolo, Eisemann 2021";
  technique.default_for.clear();
  technique.may_read.clear();
  technique.effect = {};
  technique.reads.push_back("stochastic");
  call_samples_points(technique);
  technique.parameters = technique.parameters + StochasticParams::table();
  technique.passes = [over_depth = technique.passes](const ParameterValues& values) {
    return behind_depth(over_depth(values), values.as<StochasticParams>());
  };
  return technique;
}

}  // namespace gloam
