#include "technique/ambient_occlusion.h"
#include "volumetric/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const VolumetricParams& p) {
  return {ambient_occlusion_estimate(p, "volumetric_estimate", {{"SAMPLES", p.samples}})};
}

Technique over_depth() {
  Technique t = ambient_occlusion("volumetric", "ambient occlusion: open share of the columns of a half ball",
                                  "Loos, Sloan 2010", "volumetric/volumetric.cl");
  t.parameters = VolumetricParams::table();
  t.presets = presets_of_samples();
  t.converged = {{"samples", "1024"}};
  t.passes = passes_of(passes);
  t.samples = value_of_samples;
  return t;
}

}  // namespace

std::vector<Technique> volumetric() { return {over_depth(), over_peeled_layers(over_depth())}; }

}  // namespace gloam::techniques
