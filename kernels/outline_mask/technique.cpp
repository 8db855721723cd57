#include "outline_mask/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> mask_passes(const OutlineMaskParams&) {
  return {{.name = "mask", .kernel = "outline_mask", .reads = {"outline_count"}, .writes = {{"result", "mask"}}}};
}

std::vector<Pass> ao_passes(const OutlineAoParams&) {
  return {{.name = "mask",
           .kernel = "outline_ao",
           .reads = {"outline_count", "depth"},
           .writes = {{"result", "ao_raw"}},
           .defines = {{"STAND_ALONE", 1}},
           .can_skip = true}};
}

Technique mask() {
  return {.name = "outline-mask",
          .summary = "where surfaces lie in the outlines of two or more objects",
          .paper = "OdSSAO 2020",
          .source = "outline_mask/outline_mask.cl",
          .reads = {"outline_count"},
          .writes = {"mask"},
          .parameters = OutlineMaskParams::table(),
          .passes = passes_of(mask_passes)};
}

/// The mask stands for the estimate, so it reads only what the mask needs; the filter names its own inputs.
Technique stand_alone() {
  Technique t = ambient_occlusion("outline-ao", "the mask of outline-mask itself as ambient occlusion, filtered",
                                  "OdSSAO 2020", "outline_mask/outline_mask.cl");
  t.reads = {"outline_count", "depth"};
  // The wider the filter, the more the mask looks like occlusion.
  t.then_with = {{"half_width", "4"}};
  t.parameters = OutlineAoParams::table();
  t.passes = passes_of(ao_passes);
  return t;
}

}  // namespace

std::vector<Technique> outline_mask() { return {mask(), stand_alone()}; }

}  // namespace gloam::techniques
