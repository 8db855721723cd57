#include "gloam/technique.h"

#include "volumetric/params.h"

namespace gloam::techniques {
namespace {

Pass estimate_of(const VolumetricParams& p) {
  return {.name = "estimate",
          .kernel = "volumetric_estimate",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = {{"SAMPLES", p.samples},
                      {"JITTER", p.jitter},
                      {"OUTSIDE_OPEN", p.outside == VolumetricParams::outside_values::open}}};
}

std::vector<Pass> passes(const VolumetricParams& p) { return {estimate_of(p)}; }

/// The same with every layer of the peeled depth as an occluder.
std::vector<Pass> passes_over_layers(const VolumetricParams& p) {
  Pass estimate = estimate_of(p);
  estimate.reads.push_back({"occluders", "peel"});
  return {estimate};
}

int samples(const ParameterValues& values) { return int(values.number("samples")); }

Technique over_depth() {
  return {
      .name = "volumetric",
      .summary = "ambient occlusion: open share of the columns of a half ball",
      .paper = "Loos, Sloan 2010",
      .source = "volumetric/volumetric.cl",
      .reads = {"depth", "normal"},
      .writes = {"ao_raw"},
      .outputs = {"ao", "ao_raw"},
      .then = "bilateral",
      .then_with = {{"half_width", "2"}},
      .parameters = VolumetricParams::table(),
      .presets = {{"low", {{"samples", "8"}}},
                  {"medium", {{"samples", "18"}}},
                  {"high", {{"samples", "36"}}},
                  {"ultra", {{"samples", "72"}}}},
      .converged = {{"samples", "1024"}},
      .passes = passes_of(passes),
      .samples = samples,
  };
}

Technique over_layers() {
  Technique technique = over_depth();
  technique.name = "dp-volumetric";
  technique.summary = "volumetric over all peeled depth layers: the upper bound of what more layers can give";
  technique.paper = "Vermeer, Scandolo, Eisemann 2021";
  technique.reads.push_back("peel");
  technique.passes = passes_of(passes_over_layers);
  return technique;
}

}  // namespace

std::vector<Technique> volumetric() { return {over_depth(), over_layers()}; }

}  // namespace gloam::techniques
