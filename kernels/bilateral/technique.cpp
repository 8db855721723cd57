#include "gloam/technique.h"

#include "bilateral/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const BilateralParams& p) {
  return {{"horizontal",
           "bilateral",
           {{"source", "ao_raw"}, "depth", "normal"},
           {{"result", "ao_filtered_across"}},
           {{"HALF_WIDTH", p.half_width}, {"VERTICAL", 0}}},
          {"vertical",
           "bilateral",
           {{"source", "ao_filtered_across"}, "depth", "normal"},
           {{"result", "ao"}},
           {{"HALF_WIDTH", p.half_width}, {"VERTICAL", 1}}}};
}

}  // namespace

std::vector<Technique> bilateral() {
  return {{
      .name = "bilateral",
      .summary = "separable filter for raw AO that keeps depth edges and creases",
      .paper = "Petschnigg et al. 2004; Pham, van Vliet 2005",
      .source = "bilateral/bilateral.cl",
      .reads = {"ao_raw", "depth", "normal"},
      .writes = {"ao"},
      .parameters = BilateralParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
