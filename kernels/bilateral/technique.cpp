#include "gloam/technique.h"

#include "bilateral/params.h"

namespace gloam::techniques {
namespace {

Pass pass_over(const std::string& name, const std::string& from, const std::string& to, int columns, int rows) {
  return {.name = name,
          .kernel = "bilateral",
          .reads = {{"source", from}, "depth", "normal"},
          .writes = {{"result", to}},
          .defines = {{"COLUMNS", columns}, {"ROWS", rows}}};
}

std::vector<Pass> passes(const BilateralParams& p) {
  const int taps = p.half_width;
  if (p.form == BilateralParams::form_values::square) return {pass_over("square", "ao_raw", "ao", taps, taps)};
  return {pass_over("horizontal", "ao_raw", "ao_filtered_across", taps, 0),
          pass_over("vertical", "ao_filtered_across", "ao", 0, taps)};
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
