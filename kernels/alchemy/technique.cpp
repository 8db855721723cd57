#include "gloam/technique.h"

#include <cmath>
#include <numeric>

#include "alchemy/params.h"

namespace gloam::techniques {
namespace {

/// Levels above the depth itself, as in the paper.
constexpr int levels = 5;

/// Turns of the spiral: of all numbers coprime to that of samples the one nearest to (3 - sqrt(5)) / 2 of it. That angle
/// from sample to sample spreads any run of them over all directions.
int turns_for(int samples) {
  const double wanted = samples * 0.5 * (3 - std::sqrt(5.0));
  int nearest = 1;
  for (int turns = 1; turns < samples; ++turns) {
    if (std::gcd(turns, samples) == 1 && std::abs(turns - wanted) < std::abs(nearest - wanted)) nearest = turns;
  }
  return nearest;
}

template <typename Params>
Pass estimate_of(const Params& p) {
  return {.name = "estimate",
          .kernel = "alchemy_estimate",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = {{"SAMPLES", p.samples},
                      {"TURNS", turns_for(p.samples)},
                      {"POWER", p.power},
                      {"JITTER", p.jitter},
                      {"OUTSIDE_OPEN", p.outside == Params::outside_values::open}}};
}

Pass alchemy_pass(const AlchemyParams& p) {
  Pass pass = estimate_of(p);
  pass.defines.insert(pass.defines.end(), {{"SCALABLE", 0}, {"LEVELS", 0}});
  return pass;
}

Pass sao_pass(const SaoParams& p) {
  Pass pass = estimate_of(p);
  pass.defines.insert(pass.defines.end(), {{"SCALABLE", 1}, {"LEVELS", p.levels ? levels : 0}});
  return pass;
}

/// One level of the depth.
Pass level_pass(int level) {
  return {.name = "level " + std::to_string(level),
          .kernel = "sao_level",
          .reads = {"depth"},
          .writes = {{"depth_levels", "sao_levels", levels}},
          .defines = {{"SCALABLE", 1}, {"LEVELS", levels}, {"LEVEL", level}},
          .scale = 1 << level};
}

/// The same with every layer of the peeled depth as an occluder.
Pass over_layers(Pass pass) {
  pass.reads.push_back({"occluders", "peel"});
  return pass;
}

std::vector<Pass> alchemy_passes(const AlchemyParams& p) { return {alchemy_pass(p)}; }
std::vector<Pass> alchemy_passes_over_layers(const AlchemyParams& p) { return {over_layers(alchemy_pass(p))}; }

std::vector<Pass> sao_passes(const SaoParams& p) {
  std::vector<Pass> passes;
  Pass estimate = sao_pass(p);
  if (p.levels) {
    for (int level = 1; level <= levels; ++level) passes.push_back(level_pass(level));
    estimate.reads.push_back({"depth_levels", "sao_levels", levels});
  }
  passes.push_back(estimate);
  return passes;
}

std::vector<Pass> sao_passes_over_layers(const SaoParams& p) { return {over_layers(sao_pass(p))}; }

int samples(const ParameterValues& values) { return int(values.number("samples")); }

Technique common(std::string name, std::string summary, std::string paper) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .paper = std::move(paper),
          .source = "alchemy/alchemy.cl",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .outputs = {"ao", "ao_raw"},
          .then = "bilateral",
          .then_with = {{"half_width", "2"}},
          .presets = {{"low", {{"samples", "8"}}},
                      {"medium", {{"samples", "18"}}},
                      {"high", {{"samples", "36"}}},
                      {"ultra", {{"samples", "72"}}}},
          .converged = {{"samples", "2000"}},
          .samples = samples};
}

Technique alchemy_over_depth() {
  Technique t = common("alchemy", "ambient obscurance: height over squared distance, on a spiral",
                       "McGuire, Osman, Bukowski, Hennessy 2011");
  t.parameters = AlchemyParams::table();
  t.passes = passes_of(alchemy_passes);
  return t;
}

Technique sao_over_depth() {
  Technique t = common("sao", "scalable ambient obscurance: alchemy that fades towards the radius, with depth levels",
                       "McGuire, Mara, Luebke 2012");
  t.parameters = SaoParams::table();
  t.passes = passes_of(sao_passes);
  return t;
}

Technique over_layers(Technique technique, std::function<std::vector<Pass>(const ParameterValues&)> passes) {
  technique.summary = technique.name + " over all peeled depth layers: the upper bound of what more layers can give";
  technique.name = "dp-" + technique.name;
  technique.reads.push_back("peel");
  technique.passes = std::move(passes);
  return technique;
}

}  // namespace

std::vector<Technique> alchemy() {
  return {alchemy_over_depth(), sao_over_depth(),
          over_layers(alchemy_over_depth(), passes_of(alchemy_passes_over_layers)),
          over_layers(sao_over_depth(), passes_of(sao_passes_over_layers))};
}

}  // namespace gloam::techniques
