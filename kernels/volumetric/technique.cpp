#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"

#define VOLUMETRIC_PARAMS(P)                                                                                    \
  REACH_PARAMS(P)                                                                                               \
  P(int, samples, 18, 1, 2048, "", "columns of the half ball per pixel")                                        \
  P(float, bias, 0.02f, 0, 0.99f, "", "slope above the surface up to which a visible surface occludes nothing") \
  P(float, range, 2, 0, INFINITY, "radii",                                                                      \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")

PARAMS(VolumetricParams, VOLUMETRIC_PARAMS)

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
