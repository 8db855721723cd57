#include "gloam/technique.h"

#include "gtao/params.h"

namespace gloam::techniques {
namespace {

/// What all have in common, over one depth.
template <typename Params>
Pass estimate_of(const Params& p) {
  return {.name = "estimate",
          .kernel = "gtao_estimate",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = {{"DIRECTIONS", p.directions},
                      {"STEPS", p.steps},
                      {"JITTER", p.jitter},
                      {"OUTSIDE_OPEN", p.outside == Params::outside_values::open}},
          .extras = {"bent_normal", "cone"}};
}

Pass gtao_pass(const GtaoParams& p) {
  Pass pass = estimate_of(p);
  pass.defines.push_back({"BITMASK", 0});
  pass.defines.push_back({"FADE", p.fade > 0});
  pass.defines.push_back({"THICKNESS_HEURISTIC", p.thickness_heuristic > 0});
  return pass;
}

Pass bitmask_pass(const BitmaskParams& p) {
  Pass pass = estimate_of(p);
  pass.defines.push_back({"BITMASK", 1});
  return pass;
}

/// The same with every layer of the peeled depth as an occluder.
Pass over_layers(Pass pass) {
  pass.reads.push_back({"occluders", "peel"});
  return pass;
}

std::vector<Pass> gtao_passes(const GtaoParams& p) { return {gtao_pass(p)}; }
std::vector<Pass> bitmask_passes(const BitmaskParams& p) { return {bitmask_pass(p)}; }
std::vector<Pass> gtao_passes_over_layers(const GtaoParams& p) { return {over_layers(gtao_pass(p))}; }
std::vector<Pass> bitmask_passes_over_layers(const BitmaskParams& p) { return {over_layers(bitmask_pass(p))}; }

/// On both sides of each slice.
int samples(const ParameterValues& values) { return int(2 * values.number("directions") * values.number("steps")); }

Technique common(std::string name, std::string summary, std::string paper) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .paper = std::move(paper),
          .source = "gtao/gtao.cl",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .outputs = {"ao", "ao_raw"},
          .then = "bilateral",
          .then_with = {{"half_width", "2"}},
          .extras = {"bent_normal", "cone"},
          .presets = {{"low", {{"directions", "1"}, {"steps", "4"}}},
                      {"medium", {{"directions", "1"}, {"steps", "9"}}},
                      {"high", {{"directions", "1"}, {"steps", "18"}}},
                      {"ultra", {{"directions", "4"}, {"steps", "18"}}}},
          .converged = {{"directions", "32"}, {"steps", "64"}},
          .samples = samples};
}

Technique gtao_over_depth() {
  Technique t =
      common("gtao", "ambient occlusion from horizons in slices, cosine-weighted", "Jimenez, Wu, Pesce, Jarabo 2016");
  t.parameters = GtaoParams::table();
  t.passes = passes_of(gtao_passes);
  return t;
}

Technique bitmask_over_depth() {
  Technique t = common("bitmask", "ambient occlusion from sectors in slices: occluders have a thickness",
                       "Therrien, Levesque, Gilet 2023");
  t.default_for = {"ao_raw", "bent_normal", "cone"};
  t.parameters = BitmaskParams::table();
  t.passes = passes_of(bitmask_passes);
  return t;
}

Technique over_layers(Technique technique, std::function<std::vector<Pass>(const ParameterValues&)> passes) {
  technique.summary = technique.name + " over all peeled depth layers: the upper bound of what more layers can give";
  technique.name = "dp-" + technique.name;
  technique.default_for.clear();
  technique.reads.push_back("peel");
  technique.passes = std::move(passes);
  return technique;
}

}  // namespace

std::vector<Technique> gtao() {
  return {gtao_over_depth(), bitmask_over_depth(), over_layers(gtao_over_depth(), passes_of(gtao_passes_over_layers)),
          over_layers(bitmask_over_depth(), passes_of(bitmask_passes_over_layers))};
}

}  // namespace gloam::techniques
