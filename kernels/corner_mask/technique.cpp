#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/mask_params.h"
#include "technique/cell_masks.h"

#define CORNER_MASK_PARAMS(P)                                                                    \
  REACH_PARAMS(P)                                                                                \
  MASK_SEARCH_PARAMS(P)                                                                          \
  P(float, range, 0, 0, INFINITY, "radii",                                                       \
    "something occludes up to twice this before the point, or up to the radius if that is more") \
  MASK_CELL(P)

#define HIDDEN_MASK_PARAMS(P) \
  CORNER_MASK_PARAMS(P)       \
  P(int, samples, 4, 1, 16, "", "stochastic depths per pixel")

PARAMS(CornerMaskParams, CORNER_MASK_PARAMS)
PARAMS(HiddenMaskParams, HIDDEN_MASK_PARAMS)

namespace gloam::techniques {
namespace {

template <typename Params>
Defines defines_of(const Params& p) {
  return {{"SCALE", p.cell},
          {"DIRECTIONS", p.search_directions},
          {"STEPS", p.search_steps},
          {"JITTER", p.jitter},
          {"OUTSIDE_OPEN", p.outside == Params::outside_values::open}};
}

std::vector<Pass> passes_in_cells(int cell, const Defines& defines) {
  return mask_of_cells({{.name = "subsample",
                         .kernel = "corner_subsample",
                         .reads = {"depth", "normal"},
                         .writes = {{"low_depth", "depth@cells"}, {"low_normal", "normal@cells"}},
                         .defines = defines,
                         .scale = cell},
                        {.name = "find",
                         .kernel = "corner_find",
                         .reads = {{"depth", "depth@cells"}, {"normal", "normal@cells"}},
                         .writes = {{"found", "corners"}},
                         .defines = defines,
                         .scale = cell,
                         .footprint = {.is_wide = true}}});
}

std::vector<Pass> corner_passes(const CornerMaskParams& p) { return passes_in_cells(p.cell, defines_of(p)); }

/// The passes of hidden-mask: the same search among the depths behind the first.
std::vector<Pass> hidden_passes(const HiddenMaskParams& p) {
  Defines defines = defines_of(p);
  defines.insert(defines.end(), {{"STOCHASTIC", 1}, {"OCCLUDERS_LAYERS", p.samples}});
  std::vector<Pass> passes = passes_in_cells(p.cell, defines);
  Binding hidden("hidden", "hidden@cells", p.samples);
  hidden.as_launched = true;
  Pass subsample{.name = "subsample hidden",
                 .kernel = "corner_subsample_hidden",
                 .reads = {"depth", {"stochastic", "stochastic", p.samples}},
                 .writes = {hidden},
                 .defines = defines,
                 .scale = p.cell};
  hidden.argument = "occluders";
  passes[1].reads.push_back(hidden);
  passes.insert(passes.begin() + 1, std::move(subsample));
  return passes;
}

Technique row(std::string name, std::string summary, std::string paper) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .paper = std::move(paper),
          .source = "corner_mask/corner_mask.cl",
          .reads = {"depth", "normal"},
          .writes = {"mask"}};
}

}  // namespace

std::vector<Technique> corner_mask() {
  Technique corner = row("corner-mask", "where something within the radius may occlude, from depth and normals alone",
                         "after OdSSAO 2020");
  corner.default_for = {"mask"};
  corner.parameters = CornerMaskParams::table();
  corner.passes = passes_of(corner_passes);
  Technique hidden = row("hidden-mask", "where something within the radius may occlude that the depth hides",
                         "after OdSSAO 2020, for Vermeer, Scandolo, Eisemann 2021");
  hidden.reads.push_back("stochastic");
  hidden.parameters = HiddenMaskParams::table();
  hidden.passes = passes_of(hidden_passes);
  return {std::move(corner), std::move(hidden)};
}

}  // namespace gloam::techniques
