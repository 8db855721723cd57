#include "gtao/params.h"
#include "technique/ambient_occlusion.h"
#include "technique/stereo.h"

namespace gloam::techniques {
namespace {

template <typename Params>
Pass estimate_of(const Params& p, Defines defines) {
  defines.insert(defines.end(), {{"DIRECTIONS", p.directions}, {"STEPS", p.steps}});
  Pass estimate = ambient_occlusion_estimate(p, "gtao_estimate", std::move(defines));
  estimate.extras = {"bent_normal", "cone", "specular_occlusion_raw", "lobe_weight"};
  return estimate;
}

template <typename Params>
Pass gtao_pass(const Params& p) {
  return estimate_of(p, {{"BITMASK", 0}, {"FADE", p.fade > 0}, {"THICKNESS_HEURISTIC", p.thickness_heuristic > 0}});
}

template <typename Params>
Pass bitmask_pass(const Params& p) {
  return estimate_of(p, {{"BITMASK", 1}});
}

std::vector<Pass> gtao_passes(const GtaoParams& p) { return {gtao_pass(p)}; }
std::vector<Pass> bitmask_passes(const BitmaskParams& p) { return {bitmask_pass(p)}; }
std::vector<Pass> sd_gtao_passes(const SdGtaoParams& p) { return behind_depth(gtao_pass(p), p); }
std::vector<Pass> sd_bitmask_passes(const SdBitmaskParams& p) { return behind_depth(bitmask_pass(p), p); }

std::vector<Pass> stereo_gtao_passes(const StereoGtaoParams& p) {
  return stereo_passes({gtao_pass(p)}, "stereo_slices", stereo_choices(p));
}

std::vector<Pass> stereo_bitmask_passes(const StereoBitmaskParams& p) {
  return stereo_passes({bitmask_pass(p)}, "stereo_slices", stereo_choices(p));
}

Technique row(std::string name, std::string summary, std::string paper) {
  Technique t = over_slices(ambient_occlusion(std::move(name), std::move(summary), std::move(paper), "gtao/gtao.cl"));
  t.extras = {"bent_normal", "cone", "specular_occlusion_raw", "lobe_weight"};
  t.read_for_extras = {{"specular_occlusion_raw", "roughness"}, {"lobe_weight", "roughness"}};
  return t;
}

Technique gtao_over_depth() {
  Technique t =
      row("gtao", "ambient occlusion from horizons in slices, cosine-weighted", "Jimenez, Wu, Pesce, Jarabo 2016");
  t.parameters = GtaoParams::table();
  t.passes = passes_of(gtao_passes);
  t.caution =
      "more steps may be farther from the truth: they find more occluders, and every occluder closes all behind it, so "
      "outdoors and among thin things high and ultra read too dark";
  return t;
}

Technique bitmask_over_depth() {
  Technique t = row("bitmask", "ambient occlusion from sectors in slices: occluders have a thickness",
                    "Therrien, Levesque, Gilet 2023");
  t.parameters = BitmaskParams::table();
  t.passes = passes_of(bitmask_passes);
  return t;
}

}  // namespace

std::vector<Technique> gtao() {
  return {gtao_over_depth(),
          bitmask_over_depth(),
          over_peeled_layers(gtao_over_depth()),
          over_peeled_layers(bitmask_over_depth()),
          over_stochastic_depth(gtao_over_depth(), SdGtaoParams::table(), passes_of(sd_gtao_passes)),
          over_stochastic_depth(bitmask_over_depth(), SdBitmaskParams::table(), passes_of(sd_bitmask_passes)),
          over_two_eyes(gtao_over_depth(), StereoGtaoParams::table(), passes_of(stereo_gtao_passes)),
          over_two_eyes(bitmask_over_depth(), StereoBitmaskParams::table(), passes_of(stereo_bitmask_passes))};
}

}  // namespace gloam::techniques
