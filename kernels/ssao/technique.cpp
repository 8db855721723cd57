#include "gloam/ambient_occlusion.h"
#include "ssao/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const SsaoParams& p) {
  Pass estimate =
      ambient_occlusion_estimate(p, "ssao_estimate", {{"SAMPLES", p.samples}, {"HEMISPHERE", p.hemisphere}});
  estimate.extras = {"bent_normal", "cone"};
  return {estimate};
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

}  // namespace

std::vector<Technique> ssao() { return {over_depth(), over_peeled_layers(over_depth())}; }

}  // namespace gloam::techniques
