#include "ssao/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam::techniques {
namespace {

template <typename Params>
Pass estimate_of(const Params& p, int points) {
  Pass estimate = ambient_occlusion_estimate(p, "ssao_estimate", {{"SAMPLES", points}, {"HEMISPHERE", p.hemisphere}});
  estimate.extras = {"bent_normal", "cone"};
  return estimate;
}

std::vector<Pass> passes(const SsaoParams& p) { return {estimate_of(p, p.samples)}; }
std::vector<Pass> sd_passes(const SdSsaoParams& p) { return behind_depth(estimate_of(p, p.points), p); }

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
  Technique t = with_points(over_stochastic_depth(over_depth(), SdSsaoParams::table(), passes_of(sd_passes)));
  t.summary = "ssao (points in a half ball, Mittring 2007) with stochastic depths behind what is seen";
  return t;
}

}  // namespace

std::vector<Technique> ssao() { return {over_depth(), over_peeled_layers(over_depth()), over_stochastic()}; }

}  // namespace gloam::techniques
