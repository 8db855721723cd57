#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"
#include "technique/stereo.h"

#define SLICE_PARAMS(P)                                                                        \
  REACH_PARAMS(P)                                                                              \
  P(int, directions, 1, 1, 64, "", "slices searched per pixel")                                \
  P(float, bias, 0.01f, 0, 1, "", "occluders at a lower slope above the tangent do not count") \
  P(int, steps, 9, 1, 1024, "", "samples on each side of a slice")

#define GTAO_PARAMS(P)                                                                                 \
  SLICE_PARAMS(P)                                                                                      \
  P(float, fade, 0, 0, 1, "radii", "over this outer part of the radius occluders sink to the tangent") \
  P(float, thickness_heuristic, 0, 0, 1, "",                                                           \
    "how far the horizon falls back to a sample below it; 0: occluders close everything behind them")

#define BITMASK_PARAMS(P) \
  SLICE_PARAMS(P)         \
  P(float, thickness, 0.4f, 0, INFINITY, "radii", "how far an occluder reaches behind its visible front")

// RAYS of light.h.
#define INDIRECT_PARAMS(P)                                                                                         \
  BITMASK_PARAMS(P)                                                                                                \
  P(int, rays, 2, 1, 4, "", "directions on each side of a slice in which light is looked for")                     \
  P(float, brightest, 1e20f, 0, 1e20f, "unit of color",                                                            \
    "a source of light counts up to this, in its colour: fewer fireflies beside small lamps, and less light from " \
    "them")

PARAMS(GtaoParams, GTAO_PARAMS)
PARAMS(BitmaskParams, BITMASK_PARAMS)
PARAMS(IndirectParams, INDIRECT_PARAMS)

namespace gloam::techniques {
namespace {

template <typename Params>
Pass estimate_of(const Params& p, Defines defines) {
  defines.insert(defines.end(), {{"DIRECTIONS", p.directions}, {"STEPS", p.steps}});
  Pass estimate = ambient_occlusion_estimate(p, "gtao_estimate", std::move(defines));
  estimate.extras = {"bent_normal", "cone", "specular_occlusion_raw", "lobe_weight"};
  return estimate;
}

std::vector<Pass> gtao_passes(const GtaoParams& p) {
  return {estimate_of(p, {{"BITMASK", 0}, {"FADE", p.fade > 0}, {"THICKNESS_HEURISTIC", p.thickness_heuristic > 0}})};
}

std::vector<Pass> bitmask_passes(const BitmaskParams& p) { return {estimate_of(p, {{"BITMASK", 1}})}; }

Pass indirect_pass(const IndirectParams& p) {
  Pass estimate = estimate_of(p, {{"BITMASK", 1}, {"LIGHT", 1}, {"RAYS", p.rays}});
  estimate.kernel = "indirect_estimate";
  estimate.source = "gtao/indirect.cl";
  estimate.writes = {"indirect_raw"};
  estimate.extras.insert(estimate.extras.begin(), "ao_raw");
  return estimate;
}

/// What each pixel sends, two numbers side by side.
Binding sources() { return {"sources", "indirect_sources", 2}; }

Pass pack_pass(const Defines& defines) {
  return {.name = "sources",
          .kernel = "pack_sources",
          .source = "gtao/indirect.cl",
          .reads = {"normal", "color"},
          .writes = {sources()},
          .defines = defines};
}

/// Hidden depths, where there are any, close sectors and send nothing. Of two eyes each one's pixels send their own light.
std::vector<Pass> indirect_passes(const IndirectParams& p) {
  Pass estimate = indirect_pass(p);
  estimate.reads.push_back(sources());
  return {pack_pass(estimate.defines), std::move(estimate)};
}

/// Every peeled layer sends its own light, which is read as it is.
std::vector<Pass> dp_indirect_passes(const IndirectParams& p) {
  Pass estimate = indirect_pass(p);
  estimate.reads.push_back({"occluders", "peel"});
  for (const char* component : {"r", "g", "b"})
    estimate.reads.push_back({std::string("light_") + component, std::string("peel_color_") + component});
  for (const char* component : {"x", "y", "z"})
    estimate.reads.push_back({std::string("light_normal_") + component, std::string("peel_normal_") + component});
  return {std::move(estimate)};
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
  t.recommended = "you want ambient occlusion in less time: as fast as HBAO+, and nearer to the truth";
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

Technique indirect_over_depth() {
  Technique t = row("indirect", "light that surfaces near by send, from sectors in slices; ambient occlusion beside it",
                    "Therrien, Levesque, Gilet 2023");
  t.reads = {"depth", "normal", "color"};
  t.writes = {"indirect_raw"};
  t.outputs = {"indirect", "indirect_raw"};
  t.then = "bilateral-color";
  t.extras.insert(t.extras.begin(), "ao_raw");
  t.parameters = IndirectParams::table();
  t.passes = passes_of(indirect_passes);
  t.recommended = "surfaces light each other, and the frame has colour";
  // Only what rises over a surface sends light to it. Light from near surfaces is faint in most pictures.
  t.effect = {.name = "light of near surfaces",
              .changes = "indirect",
              .mask = "corner-mask",
              .probe = {{"cell", "8"}, {"search_steps", "2"}},
              .most_share = 0.8,
              .least_change = 0.01,
              .somewhere = "surfaces within the radius send light",
              .nowhere = "nothing rises over any surface within the radius"};
  return t;
}

Technique indirect_over_two_eyes() {
  Technique t = over_two_eyes(indirect_over_depth(), "stereo_slices");
  t.effect = {.name = "light alike in two views",
              .refines = "indirect",
              .mask = "stereo-visibility",
              .probe_resolution = 4,
              .least_share = 0.5,
              .somewhere = "the two views have to agree, and both see the same",
              .nowhere = "the two views have too little in common"};
  return t;
}

Technique indirect_over_layers() {
  Technique t = over_peeled_layers(indirect_over_depth());
  t.reads = {"depth", "normal", "peel"};
  for (const char* light : {"color_r", "color_g", "color_b", "normal_x", "normal_y", "normal_z"})
    t.reads.push_back(std::string("peel_") + light);
  t.passes = passes_of(dp_indirect_passes);
  return t;
}

}  // namespace

std::vector<Technique> gtao() {
  return {gtao_over_depth(),
          bitmask_over_depth(),
          indirect_over_depth(),
          over_peeled_layers(gtao_over_depth()),
          over_peeled_layers(bitmask_over_depth()),
          indirect_over_layers(),
          over_stochastic_depth(indirect_over_depth()),
          over_stochastic_depth(gtao_over_depth()),
          over_stochastic_depth(bitmask_over_depth()),
          over_two_eyes(gtao_over_depth(), "stereo_slices"),
          over_two_eyes(bitmask_over_depth(), "stereo_slices"),
          indirect_over_two_eyes()};
}

}  // namespace gloam::techniques
