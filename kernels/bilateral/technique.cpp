#include "bilateral/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const BilateralParams& p) {
  return bilateral_passes(p.half_width, p.form == BilateralParams::form_values::square, "ao");
}

}  // namespace

std::vector<Technique> bilateral() {
  return {{
      .name = "bilateral",
      .summary = "filter for raw AO that keeps depth edges and creases",
      .paper = "Petschnigg et al. 2004; Pham, van Vliet 2005",
      .source = "bilateral/bilateral.cl",
      .reads = {"ao_raw", "depth", "normal"},
      .writes = {"ao"},
      .parameters = BilateralParams::table(),
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
