#include "gloam/technique.h"

#include "corner_mask/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const CornerMaskParams& p) {
  const std::vector<std::pair<std::string, int>> defines = {
      {"SCALE", p.cell},
      {"DIRECTIONS", p.search_directions},
      {"STEPS", p.search_steps},
      {"JITTER", p.jitter},
      {"OUTSIDE_OPEN", p.outside == CornerMaskParams::outside_values::open}};
  return {{.name = "subsample",
           .kernel = "corner_subsample",
           .reads = {"depth", "normal"},
           .writes = {{"low_depth", "depth@cells"}, {"low_normal", "normal@cells"}},
           .defines = defines,
           .scale = p.cell},
          {.name = "find",
           .kernel = "corner_find",
           .reads = {{"depth", "depth@cells"}, {"normal", "normal@cells"}},
           .writes = {{"found", "corners"}},
           .defines = defines,
           .scale = p.cell,
           .looks_around = true},
          {.name = "grow",
           .kernel = "corner_grow",
           .reads = {{"found", "corners"}},
           .writes = {{"grown", "corners.grown"}},
           .defines = defines,
           .scale = p.cell},
          {.name = "spread",
           .kernel = "corner_spread",
           .reads = {{"grown", "corners.grown"}},
           .writes = {{"result", "mask"}},
           .defines = defines,
           .repeats_cells = true}};
}

}  // namespace

std::vector<Technique> corner_mask() {
  return {{
      .name = "corner-mask",
      .summary = "where something within the radius may occlude, from depth and normals alone",
      .paper = "after OdSSAO 2020",
      .source = "corner_mask/corner_mask.cl",
      .reads = {"depth", "normal"},
      .writes = {"mask"},
      .default_for = {"mask"},
      .parameters = CornerMaskParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
