#include "gloam/technique.h"

#include "shared/both/params.h"

#define STOCHASTIC_DEPTH_PARAMS(P)                                                        \
  P(int, samples, 4, 1, 16, "", "depths per pixel")                                       \
  P(float, alpha, 0.2f, 0, 1, "", "share of the samples that each surface is offered to") \
  P(choice, subset, stratified, (stratified, hashed),                                     \
    "which samples are offered a surface: a stratified subset, or each by a random number of its own")

PARAMS(StochasticDepthParams, STOCHASTIC_DEPTH_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const StochasticDepthParams& p) {
  return {{.name = "map",
           .kernel = "stochastic_depth_map",
           .reads = {"depth", "peel"},
           .writes = {{"stochastic", "stochastic", p.samples}},
           .defines = {{"SAMPLES", p.samples}, {"HASHED", p.subset == StochasticDepthParams::subset_values::hashed}}}};
}

}  // namespace

std::vector<Technique> stochastic_depth() {
  return {{
      .name = "stochastic-depth",
      .summary = "depths of surfaces chosen at random among all under a pixel, seen or hidden",
      .paper = "Vermeer, Scandolo, Eisemann 2021",
      .source = "stochastic_depth/stochastic_depth.cl",
      .reads = {"depth", "peel"},
      .writes = {"stochastic"},
      .parameters = StochasticDepthParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
