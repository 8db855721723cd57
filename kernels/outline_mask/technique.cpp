#include "shared/both/params.h"
#include "technique/ambient_occlusion.h"

#define OUTLINE_MASK_PARAMS(P)                                                                                   \
  P(float, least_count, 2, 1, INFINITY, "",                                                                      \
    "a pixel is wanted if its surface lies in at least this many outlines, or their count is below 0, as where " \
    "an outline crosses itself")

#define OUTLINE_AO_PARAMS(P) \
  OUTLINE_MASK_PARAMS(P)     \
  P(float, occlusion, 0.25f, 0, 1, "", "occlusion of such a pixel")

PARAMS(OutlineMaskParams, OUTLINE_MASK_PARAMS)
PARAMS(OutlineAoParams, OUTLINE_AO_PARAMS)

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
