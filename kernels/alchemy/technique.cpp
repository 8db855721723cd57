#include <cmath>
#include <numeric>

#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"

#define SPIRAL_PARAMS(P) \
  REACH_PARAMS(P)        \
  P(int, samples, 18, 1, 2048, "", "samples per pixel, on a spiral")

#define ALCHEMY_PARAMS(P)                                                                                   \
  SPIRAL_PARAMS(P)                                                                                          \
  P(float, strength, 0.7f, 0, 8, "radii", "factor on the obscurance (sigma)")                               \
  P(float, bias, 1.5e-3f, 0, 1, "depths", "occluders lower than this above the tangent plane do not count") \
  P(float, epsilon, 0.02f, 0, 1, "squared radii", "limits what occluders close to the pixel contribute")    \
  P(int, power, 1, 1, 4, "", "exponent on the result, for contrast (k)")

#define SAO_PARAMS(P)                                                                                       \
  SPIRAL_PARAMS(P)                                                                                          \
  P(float, strength, 0.6f, 0, 8, "radii", "factor on the obscurance (sigma)")                               \
  P(float, bias, 1.5e-3f, 0, 1, "depths", "occluders lower than this above the tangent plane do not count") \
  P(float, epsilon, 0.05f, 0, 1, "squared radii", "limits what occluders close to the pixel contribute")    \
  P(int, power, 1, 1, 4, "", "exponent on the result, for contrast")                                        \
  P(bool, levels, off, "read samples that are far away on the screen from coarser levels of the depth")     \
  P(int, level_offset, 3, 0, 8, "", "levels begin at 2^(this + 1) pixels from the pixel")

PARAMS(AlchemyParams, ALCHEMY_PARAMS)
PARAMS(SaoParams, SAO_PARAMS)

namespace gloam::techniques {
namespace {

/// Levels above the depth itself, as in the paper.
constexpr int levels = 5;

/// Turns of the spiral: the number coprime to `samples` that is nearest to (3 - sqrt(5)) / 2 * samples. With the resulting
/// angle between samples, any run of samples is spread over all directions.
int turns_for(int samples) {
  const double wanted = samples * 0.5 * (3 - std::sqrt(5.0));
  int nearest = 1;
  for (int turns = 1; turns < samples; ++turns) {
    if (std::gcd(turns, samples) == 1 && std::abs(turns - wanted) < std::abs(nearest - wanted)) nearest = turns;
  }
  return nearest;
}

template <typename Params>
Pass estimate_of(const Params& p, bool scalable, int levels) {
  return ambient_occlusion_estimate(p, "alchemy_estimate",
                                    {{"SAMPLES", p.samples},
                                     {"TURNS", turns_for(p.samples)},
                                     {"POWER", p.power},
                                     {"SCALABLE", scalable},
                                     {"LEVELS", levels}});
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

std::vector<Pass> alchemy_passes(const AlchemyParams& p) { return {estimate_of(p, false, 0)}; }

std::vector<Pass> sao_passes(const SaoParams& p) {
  if (!p.levels) return {estimate_of(p, true, 0)};
  std::vector<Pass> passes;
  for (int level = 1; level <= levels; ++level) passes.push_back(level_pass(level));
  passes.push_back(estimate_of(p, true, levels));
  passes.back().reads.push_back({"depth_levels", "sao_levels", levels});
  return passes;
}

/// Layers behind the depth have no levels: all are read at the pixels of the levels.
std::vector<Pass> sao_passes_without_levels(const SaoParams& p) {
  return {estimate_of(p, true, p.levels ? levels : 0)};
}

Technique row(std::string name, std::string summary, std::string paper) {
  Technique t = ambient_occlusion(std::move(name), std::move(summary), std::move(paper), "alchemy/alchemy.cl");
  t.presets = presets_of_samples();
  t.converged = {{"samples", "2000"}};
  t.samples = value_of_samples;
  return t;
}

Technique alchemy_over_depth() {
  Technique t = row("alchemy", "ambient obscurance: height over squared distance, on a spiral",
                    "McGuire, Osman, Bukowski, Hennessy 2011");
  t.parameters = AlchemyParams::table();
  t.passes = passes_of(alchemy_passes);
  return t;
}

Technique sao(std::vector<Pass> (*passes)(const SaoParams&)) {
  Technique t = row("sao", "scalable ambient obscurance: alchemy that fades towards the radius, with depth levels",
                    "McGuire, Mara, Luebke 2012");
  t.parameters = SaoParams::table();
  t.passes = passes_of(passes);
  return t;
}

}  // namespace

std::vector<Technique> alchemy() {
  return {alchemy_over_depth(),
          sao(sao_passes),
          over_peeled_layers(alchemy_over_depth()),
          over_peeled_layers(sao(sao_passes_without_levels)),
          over_stochastic_depth(alchemy_over_depth()),
          over_stochastic_depth(sao(sao_passes_without_levels))};
}

}  // namespace gloam::techniques
