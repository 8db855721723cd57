#include "gloam/technique.h"

#include "ssao/params.h"

namespace gloam::techniques {
namespace {

Pass estimate_of(const SsaoParams& p) {
  return {.name = "estimate",
          .kernel = "ssao_estimate",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = {{"SAMPLES", p.samples},
                      {"HEMISPHERE", p.hemisphere},
                      {"JITTER", p.jitter},
                      {"OUTSIDE_OPEN", p.outside == SsaoParams::outside_values::open}},
          .extras = {"bent_normal", "cone"}};
}

std::vector<Pass> passes(const SsaoParams& p) { return {estimate_of(p)}; }

/// The same with every layer of the peeled depth as an occluder.
std::vector<Pass> passes_over_layers(const SsaoParams& p) {
  Pass estimate = estimate_of(p);
  estimate.reads.push_back({"occluders", "peel"});
  return {estimate};
}

int samples(const ParameterValues& values) { return int(values.number("samples")); }

Technique over_depth() {
  return {
      .name = "ssao",
      .summary = "ambient occlusion: share of the points in a half ball with nothing before them",
      .paper = "Mittring 2007",
      .source = "ssao/ssao.cl",
      .reads = {"depth", "normal"},
      .writes = {"ao_raw"},
      .outputs = {"ao", "ao_raw"},
      .then = "bilateral",
      .then_with = {{"half_width", "2"}},
      .extras = {"bent_normal", "cone"},
      .parameters = SsaoParams::table(),
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
  technique.name = "dp-ssao";
  technique.summary = "ssao over all peeled depth layers: the upper bound of what more layers can give";
  technique.paper = "Vermeer, Scandolo, Eisemann 2021";
  technique.reads.push_back("peel");
  technique.passes = passes_of(passes_over_layers);
  return technique;
}

}  // namespace

std::vector<Technique> ssao() { return {over_depth(), over_layers()}; }

}  // namespace gloam::techniques
