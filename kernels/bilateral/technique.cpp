#include "shared/both/params.h"
#include "shared/filter/bilateral_params.h"
#include "technique/ambient_occlusion.h"

#define BILATERAL_FILTER_PARAMS(P)                                        \
  P(float, radius, 0.5f, 0, INFINITY, "scene units",                      \
    "radius of the estimate to be filtered: the unit of depth_tolerance") \
  BILATERAL_PARAMS(P)                                                     \
  P(choice, form, separable, (separable, square),                         \
    "along rows and then along columns, or over the whole square at once")

PARAMS(BilateralParams, BILATERAL_FILTER_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> filter(const BilateralParams& p, const std::string& source, const std::string& result) {
  return bilateral_passes(p.half_width, p.form == BilateralParams::form_values::square, source, result);
}

std::vector<Pass> ao_passes(const BilateralParams& p) { return filter(p, "ao_raw", "ao"); }
std::vector<Pass> color_passes(const BilateralParams& p) { return filter(p, "indirect_raw", "indirect"); }
std::vector<Pass> environment_passes(const BilateralParams& p) { return filter(p, "environment_raw", "environment"); }

Technique row(std::string name, std::string summary, const std::string& source, std::string result) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .paper = "Petschnigg et al. 2004; Pham, van Vliet 2005",
          .source = "bilateral/bilateral.cl",
          .reads = {source, "depth", "normal"},
          .writes = {std::move(result)},
          .parameters = BilateralParams::table()};
}

}  // namespace

std::vector<Technique> bilateral() {
  Technique ao = row("bilateral", "filter for raw AO that keeps depth edges and creases", "ao_raw", "ao");
  ao.passes = passes_of(ao_passes);
  Technique color = row("bilateral-color", "the same filter for raw indirect light", "indirect_raw", "indirect");
  color.passes = passes_of(color_passes);
  Technique environment =
      row("bilateral-environment", "the same filter for raw light of an environment", "environment_raw", "environment");
  environment.passes = passes_of(environment_passes);
  return {std::move(ao), std::move(color), std::move(environment)};
}

}  // namespace gloam::techniques
