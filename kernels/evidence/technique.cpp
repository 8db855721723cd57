#include <algorithm>

#include "base/files.h"
#include "evidence/coefficients.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "shared/rays/environment_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"
#include "technique/environment_light.h"
#include "technique/stereo.h"

#define EVIDENCE_PARAMS(P)                                                                          \
  REACH_PARAMS(P)                                                                                   \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                     \
  P(float, bias, 0.01f, 0, 1, "", "slope above the tangent below which an occluder does not count") \
  P(int, steps, 9, 1, 64, "", "samples on each side of a slice")                                    \
  P(file, coefficients,                                                                             \
    "coefficients fitted to scenes of your own, as `bench_fit` writes them; none: the built-in "    \
    "ones")

// Not of two eyes.
#define EVIDENCE_EDGE_PARAMS(P)                                                                                   \
  P(int, edge_factor, 4, 1, 16, "",                                                                               \
    "how many times as many slices are searched at pixels that no filter averages, as their four neighbours are " \
    "other surfaces")

// `rays`: RAYS of missing_light.h.
#define ENVIRONMENT_LIGHT_PARAMS(P)                                                                                 \
  P(choice, method, slices, (slices, bent_normal, normal),                                                          \
    "what tells which light arrives: the closed directions of each slice, or ambient occlusion as a factor on the " \
    "light on a surface that faces the mean open direction (bent_normal) or the normal's")                          \
  P(int, rays, 2, 1, 4, "", "directions on each side of a slice in which light is read; of slices")                 \
  ENVIRONMENT_PARAMS(P, "even light of radiance 1")

PARAMS(EvidenceParams, EVIDENCE_PARAMS)
PARAMS(EvidenceEdgeParams, EVIDENCE_EDGE_PARAMS)
PARAMS(EnvironmentParams, ENVIRONMENT_LIGHT_PARAMS)

namespace gloam::techniques {
namespace {

/// The sets that a file holds; the built-in ones without a file.
std::vector<EvidenceSet> sets_of(const std::string& file) {
  return file.empty() ? fitted_evidence_sets() : evidence_sets(read_text(file), file);
}

/// w, v, e and g of evidence.cl, one after another. What lies outside of the image is as unknown in a scene of the user's: where a file
/// was fitted without g, the built-in one serves.
void append(std::vector<float>& table, const EvidenceSet& set) {
  table.insert(table.end(), set.closed.begin(), set.closed.end());
  table.insert(table.end(), set.error.begin(), set.error.end());
  const EvidenceSet* fitted = nearest_set(fitted_evidence_sets(), set.occluders, set.directions, set.steps);
  table.push_back(set.outside.value_or(fitted ? fitted->outside.value_or(0) : 0));
}

/// The estimate from what `occluders` names, a kind of EvidenceSet.
Pass estimate_of(const EvidenceParams& p, const std::string& occluders, int edge_factor) {
  Pass estimate = ambient_occlusion_estimate(
      p, "evidence_estimate",
      {{"DIRECTIONS", p.directions}, {"STEPS", p.steps}, {"EDGE_FACTOR", edge_factor}, {"SURE_BIAS", p.bias >= 0.01f}});
  const std::string file = file_name(p.coefficients);
  const std::vector<EvidenceSet> sets = sets_of(file);
  const EvidenceSet* set = nearest_set(sets, occluders, p.directions, p.steps);
  if (!set)
    throw UsageError("coefficients = '{}' is not allowed; it has none for occluders by {} (bench_fit --occluders {})",
                     file, occluders, occluders);
  std::vector<float> table;
  append(table, *set);
  // A thickness that is known has coefficients of its own behind these.
  const EvidenceSet* known = nearest_set(sets, "back_depth", p.directions, p.steps);
  if (occluders == "depth" && known) {
    append(table, *known);
    estimate.may_read = {"back_depth"};
  }
  estimate.tables = {{"coefficients", std::move(table)}};
  estimate.extras = {"bent_normal", "cone", "specular_occlusion_raw", "lobe_weight", {"ao_error", "ao_error_raw"}};
  return estimate;
}

/// Filters the expected error as AO is filtered by default.
Pass error_filter() {
  constexpr int taps = 3;
  Pass pass{
      .name = "filter error",
      .kernel = "bilateral",
      .reads = {{"source", "ao_error_raw"}, "depth", "normal"},
      .defines =
          {{"DIRECTIONS", 1}, {"STEPS", 1}, {"EDGE_FACTOR", 1}, {"SURE_BIAS", 1}, {"COLUMNS", taps}, {"ROWS", taps}},
      .extras = {{"result", "ao_error"}},
      .footprint = {.columns = taps, .rows = taps},
      .can_skip = true};
  return pass;
}

Pass mono_pass(const ParameterValues& values, const std::string& occluders) {
  return estimate_of(values.as<EvidenceParams>(), occluders, values.as<EvidenceEdgeParams>().edge_factor);
}

/// Has the estimate list the pixels that no filter averages, and adds a pass that computes these from more slices.
Technique with_slices_at_edges(Technique t) {
  t.passes = [without = t.passes](const ParameterValues& values) {
    std::vector<Pass> passes = without(values);
    if (values.as<EvidenceEdgeParams>().edge_factor == 1) return passes;
    const auto estimate =
        std::find_if(passes.begin(), passes.end(), [](const Pass& p) { return p.name == "estimate"; });
    Pass isolated = *estimate;
    isolated.name = "isolated";
    isolated.reads.push_back("isolated");
    isolated.defines.emplace_back("LISTED", 1);
    isolated.can_skip = false;
    estimate->writes.push_back(starts_empty("isolated"));
    passes.insert(estimate + 1, std::move(isolated));
    return passes;
  };
  return t;
}

std::vector<Pass> over_depth(const ParameterValues& values) { return {mono_pass(values, "depth"), error_filter()}; }
std::vector<Pass> over_layers(const ParameterValues& values) { return {mono_pass(values, "peel"), error_filter()}; }
std::vector<Pass> behind(const ParameterValues& values) { return {mono_pass(values, "stochastic"), error_filter()}; }
std::vector<Pass> of_two_eyes(const EvidenceParams& p) { return {estimate_of(p, "depth", 1)}; }

Pass environment_pass(const ParameterValues& values, const std::string& occluders) {
  const auto p = values.as<EnvironmentParams>();
  Pass estimate = mono_pass(values, occluders);
  estimate.kernel = "environment_estimate";
  estimate.source = "evidence/environment.cl";
  estimate.writes = {"environment_raw"};
  estimate.extras = {"ao_raw", "bent_normal", "cone"};
  using Method = EnvironmentParams::method_values;
  estimate.defines.insert(estimate.defines.end(), {{"BY_BENT_NORMAL", p.method == Method::bent_normal},
                                                   {"BY_NORMAL", p.method == Method::normal},
                                                   {"RAYS", p.rays}});
  return with_environment(std::move(estimate), p, EnvironmentLight::coarsest);
}

std::vector<Pass> environment_over_depth(const ParameterValues& values) { return {environment_pass(values, "depth")}; }
std::vector<Pass> environment_over_layers(const ParameterValues& values) { return {environment_pass(values, "peel")}; }

std::string environment_note(const ParameterValues& values, const View& view) {
  return environment_assumption(
      values.as<EnvironmentParams>(), view,
      fmt::format("environment: no map is given, so light is 1 from all around; give {}, a lat-long map",
                  option("environment", "FILE")));
}

/// The technique that `ao` stands for, and that `gloam auto` runs: the nearest to the truth on nearly every frame (README.md).
Technique evidence_over_depth() {
  Technique t = over_slices(ambient_occlusion(
      "evidence", "ambient occlusion expected from what slices show: thickness is judged by extent",
      "coefficients fitted to ray-traced truth; slices after Jimenez, Wu, Pesce, Jarabo 2016", "evidence/evidence.cl"));
  t.then_with = {{"half_width", "3"}};
  t.extras = {"bent_normal", "cone", "specular_occlusion_raw", "lobe_weight", "ao_error"};
  t.read_for_extras = {{"specular_occlusion_raw", "roughness"}, {"lobe_weight", "roughness"}};
  t.may_read = {"back_depth"};
  t.parameters = EvidenceParams::table() + EvidenceEdgeParams::table();
  t.passes = over_depth;
  t.recommended = "you want ambient occlusion: nearest to the truth on most frames";
  t.default_for = {"ao_raw", "bent_normal", "cone", "specular_occlusion_raw", "lobe_weight"};
  t.effect = {.name = "ambient occlusion",
              .changes = "ao",
              .mask = "corner-mask",
              .probe = {{"cell", "8"}, {"search_steps", "2"}},
              .most_share = 0.8,
              .somewhere = "something rises over the surface within the radius",
              .nowhere = "nothing rises over any surface within the radius"};
  return t;
}

Technique evidence_over_layers() {
  Technique t = evidence_over_depth();
  t.passes = over_layers;
  return over_peeled_layers(std::move(t));
}

Technique evidence_over_stochastic_depth() {
  Technique t = evidence_over_depth();
  t.passes = behind;
  t = over_stochastic_depth(std::move(t));
  t.effect = {.name = "hidden layers",
              .refines = "evidence",
              .mask = "hidden-mask",
              .probe = {{"cell", "16"}, {"search_steps", "2"}},
              .most_share = 0.5,
              .somewhere = "a hidden surface rises over a visible one",
              .nowhere = "no hidden surface rises over a visible one"};
  return t;
}

/// The second eye reuses what the first finds wherever both see the same surface: only the rest is computed for it.
Technique evidence_over_two_eyes() {
  Technique t = evidence_over_depth();
  t.parameters = EvidenceParams::table();
  t.passes = passes_of(of_two_eyes);
  t = over_two_eyes(std::move(t), "stereo_slices");
  t.effect = {.name = "two views alike",
              .refines = "evidence",
              .mask = "stereo-visibility",
              .probe_resolution = 4,
              .least_share = 0.5,
              .settings = {{"estimate", "mono"}, {"filter", "mono"}},
              .somewhere = "the second view reuses the result of the first, and both see the same",
              .nowhere = "the two views have too little in common"};
  return t;
}

Technique environment() {
  Technique t = over_slices(
      ambient_occlusion("environment", "light of an environment, a lat-long map, from directions that are open",
                        "Klehm, Ritschel, Eisemann, Seidel 2012; slices after Jimenez, Wu, Pesce, Jarabo 2016",
                        "evidence/environment.cl"));
  t.writes = {"environment_raw"};
  t.outputs = {"environment", "environment_raw"};
  t.then = "bilateral-environment";
  t.then_with = {{"half_width", "3"}};
  t.extras = {"ao_raw", "bent_normal", "cone"};
  t.may_read = {"back_depth"};
  t.parameters = EvidenceParams::table() + EvidenceEdgeParams::table() + EnvironmentParams::table();
  t.passes = environment_over_depth;
  t.assumes = environment_note;
  t.effect = {.name = "light of an environment",
              .changes = "environment",
              .needs = "environment",
              .somewhere = "the environment lights what is open"};
  return t;
}

Technique environment_of_layers() {
  Technique t = environment();
  t.passes = environment_over_layers;
  return over_peeled_layers(std::move(t));
}

}  // namespace

std::vector<Technique> evidence() {
  std::vector<Technique> one_eye = {evidence_over_depth(), evidence_over_layers(), evidence_over_stochastic_depth(),
                                    environment(), environment_of_layers()};
  std::vector<Technique> all = {evidence_over_two_eyes()};
  for (Technique& t : one_eye) all.push_back(with_slices_at_edges(std::move(t)));
  return all;
}

}  // namespace gloam::techniques
