#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"

#define SSAO_PARAMS(P)                                                                                          \
  REACH_PARAMS(P)                                                                                               \
  P(int, samples, 18, 1, 2048, "", "points looked at per pixel")                                                \
  P(bool, hemisphere, on, "points in the half ball above the surface; off: in the whole ball, as in the paper") \
  P(float, inner, 0, 0, 0.99f, "radii", "least distance of the points: a shell instead of a ball")              \
  P(float, bias, 0.02f, 0, 0.99f, "",                                                                           \
    "slope above the surface up to which a visible surface occludes no point of the half ball")                 \
  P(float, range, 2, 0, INFINITY, "radii",                                                                      \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")

PARAMS(SsaoParams, SSAO_PARAMS)

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
