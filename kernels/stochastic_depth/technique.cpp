#include "gloam/technique.h"

#include "shared/both/params.h"
#include "shared/both/relevant.h"

#define STOCHASTIC_DEPTH_PARAMS(P)                                                                                    \
  P(int, samples, 4, 1, 16, "", "depths per pixel")                                                                   \
  P(choice, surfaces, hidden, (all, hidden, relevant),                                                                \
    "which surfaces under a pixel are offered to the samples: all, as in the paper; those behind the nearest; or of " \
    "these the ones that may be within the radius of something visible")                                              \
  P(choice, subset, nearest, (stratified, hashed, nearest),                                                           \
    "which samples are offered a surface: a stratified subset, as in the paper, or each by a random number of "       \
    "its own; nearest: nothing is random, and the samples hold the nearest surfaces, front to back")                  \
  P(float, alpha, 0.25f, 0, 1, "",                                                                                    \
    "share of the samples that each surface is offered to, at random; the paper's is 0.2")                            \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                                                                  \
    "distance up to which occluders count: which surfaces are relevant")                                              \
  P(float, max_reach, 0.25f, 0, 1, "image widths", "cap on the radius on the screen: which surfaces are relevant")

PARAMS(StochasticDepthParams, STOCHASTIC_DEPTH_PARAMS)

namespace gloam::techniques {
namespace {

using Surfaces = StochasticDepthParams::surfaces_values;
using Subset = StochasticDepthParams::subset_values;

std::vector<Pass> passes(const StochasticDepthParams& p) {
  const bool is_relevant = p.surfaces == Surfaces::relevant;
  Pass map{.name = "map",
           .kernel = "stochastic_depth_map",
           .reads = {"depth", "peel"},
           .writes = {{"stochastic", "stochastic", p.samples}},
           .defines = {{"SAMPLES", p.samples},
                       {"HIDDEN", p.surfaces != Surfaces::all},
                       {"HASHED", p.subset == Subset::hashed},
                       {"JITTER", p.subset != Subset::nearest},
                       {"RELEVANT", is_relevant}}};
  if (!is_relevant) return {std::move(map)};
  map.reads.push_back({"slices", "slices@tiles"});
  const auto of_tiles = [&](std::string name, std::string kernel, std::vector<Binding> reads,
                            std::vector<Binding> writes) {
    return Pass{.name = std::move(name),
                .kernel = std::move(kernel),
                .reads = std::move(reads),
                .writes = std::move(writes),
                .defines = map.defines,
                .scale = RELEVANT_TILE};
  };
  const Binding slices("slices", "slices@own"), reach("reach", "reach@own"), row_slices("row_slices", "slices@rows"),
      further("further", "reach@rows");
  return {of_tiles("slices", "slices_of_tiles", {"depth"}, {slices, reach}),
          of_tiles("slices across", "slices_across", {slices, reach}, {row_slices, further}),
          of_tiles("slices down", "slices_down", {row_slices, further}, {map.reads.back()}), std::move(map)};
}

/// Says that a share was given where nothing is drawn.
std::string unused_alpha(const ParameterValues& values, const View&) {
  const auto p = values.as<StochasticDepthParams>();
  if (p.subset != Subset::nearest || p.alpha == StochasticDepthParams().alpha) return "";
  return fmt::format(
      "stochastic-depth: alpha {:g} changes nothing, as the nearest surfaces are kept and none is drawn at random; set "
      "subset to stratified as well",
      p.alpha);
}

}  // namespace

std::vector<Technique> stochastic_depth() {
  return {{
      .name = "stochastic-depth",
      .summary = "depths of some of the surfaces under a pixel: the nearest hidden ones, or chosen at random",
      .paper = "Vermeer, Scandolo, Eisemann 2021",
      .source = "stochastic_depth/stochastic_depth.cl",
      .reads = {"depth", "peel"},
      .writes = {"stochastic"},
      .parameters = StochasticDepthParams::table(),
      .passes = passes_of(passes),
      .assumes = unused_alpha,
  }};
}

}  // namespace gloam::techniques
