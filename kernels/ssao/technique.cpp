#include "ssao/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const SsaoParams& p) {
  Pass estimate =
      ambient_occlusion_estimate(p, "ssao_estimate", {{"SAMPLES", p.samples}, {"HEMISPHERE", p.hemisphere}});
  estimate.extras = {"bent_normal", "cone"};
  return {std::move(estimate)};
}

Technique over_depth() {
  Technique t =
      ambient_occlusion("ssao", "ambient occlusion: share of the points in a half ball with nothing before them",
                        "Mittring 2007", "ssao/ssao.cl");
  t.extras = {"bent_normal", "cone"};
  t.parameters = SsaoParams::table();
  t.presets = presets_of_samples();
  t.converged = {{"samples", "1024"}};
  t.passes = passes_of(passes);
  t.samples = value_of_samples;
  return t;
}

/// Not the SSAO of the paper, which is that of `sd-alchemy` and `sd-sao`.
Technique over_stochastic() {
  Technique t = over_stochastic_depth(over_depth());
  t.summary = "ssao (points in a half ball, Mittring 2007) with stochastic depths behind what is seen";
  return t;
}

}  // namespace

std::vector<Technique> ssao() { return {over_depth(), over_peeled_layers(over_depth()), over_stochastic()}; }

}  // namespace gloam::techniques
