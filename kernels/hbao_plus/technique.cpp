#include "hbao_plus/params.h"
#include "technique/ambient_occlusion.h"
#include "technique/stereo.h"

namespace gloam::techniques {
namespace {

using Falloff = HbaoPlusParams::falloff_values;

std::vector<Pass> passes(const HbaoPlusParams& p) {
  return {ambient_occlusion_estimate(p, "hbao_plus_estimate",
                                     {{"DIRECTIONS", p.directions},
                                      {"STEPS", p.steps},
                                      {"POWER", p.power},
                                      {"NO_FALLOFF", p.falloff == Falloff::none}})};
}

/// Algorithm 3, for the first view. Reads stochastic depths of both views, of the second at its own resolution.
std::vector<Pass> multiview_passes(const ParameterValues& values) {
  std::vector<Pass> own = passes(values.as<HbaoPlusParams>());
  own.back().writes = {{"ao_raw", "multiview_own"}};
  own.back().on = On::first_view;
  own.back().defines.push_back({"MULTIVIEW", 1});
  std::vector<Pass> passes = behind_depth(std::move(own), values.as<StochasticParams>());
  Binding other_depth = "depth", other_hidden = passes.back().reads.back();  // added by behind_depth
  if (const int scale = 1 << values.as<OtherViewParams>().other_resolution; scale > 1) {
    Pass sort = at_lower_resolution(passes.front(), scale);
    passes.front().on = On::first_view;
    sort.on = On::second_view;
    other_depth = sort.writes.front();
    other_hidden = {other_hidden.argument, sort.writes.back().plane, other_hidden.layers};
    passes.insert(passes.begin() + 1, std::move(sort));
  }
  Pass other = passes.back();
  other.name = "other view";
  other.kernel = "hbao_plus_other_view";
  other.reads = {"depth",
                 "normal",
                 {"own", "multiview_own"},
                 from(From::other_view, {"other_depth", other_depth.plane}),
                 from(From::other_view, other_hidden)};
  other.writes = {"ao_raw"};
  passes.push_back(std::move(other));
  return passes;
}

/// The estimate's limit for many samples, as an integral over directions; `power` is applied after it and left out here.
double contribution(const HbaoPlusParams& p, double cosine, double distance) {
  if (distance >= 1 || cosine <= p.bias) return 0;
  const double weight = p.falloff == Falloff::none ? 1 : 1 - distance * distance;
  return p.strength * weight * (cosine - p.bias) / cosine;
}

Technique over_depth() {
  Technique t = ambient_occlusion("hbao+", "ambient occlusion: mean obscurance over directions x steps on the screen",
                                  "Bavoil, Sainz 2008; NVIDIA 2016", "hbao_plus/hbao_plus.cl");
  // The filter keeps its own default width: so few directions leave more noise.
  t.then_with.clear();
  t.parameters = HbaoPlusParams::table();
  t.presets = {{"low", {{"directions", "4"}, {"steps", "4"}}},
               {"medium", {{"directions", "8"}, {"steps", "4"}}},
               {"high", {{"directions", "8"}, {"steps", "8"}}},
               {"ultra", {{"directions", "16"}, {"steps", "16"}}}};
  t.converged = {{"directions", "32"}, {"steps", "32"}};
  t.passes = passes_of(passes);
  t.samples = directions_times_steps;
  t.contribution = contribution_of(contribution);
  return t;
}

Technique multiview() {
  Technique t = over_stochastic_depth(over_depth());
  t.variant = {};  // a method of its own
  t.name = "multiview";
  t.summary = "sd-hbao+ for the first of two views, with occluders from both";
  t.paper = "Vermeer, Scandolo, Eisemann 2021";
  t.views = 2;
  t.parameters = t.parameters + OtherViewParams::table();
  t.passes = multiview_passes;
  return t;
}

Technique stereo_ao() {
  Technique t = over_two_eyes(over_depth(), "hbao_plus_stereo");
  t.name = "stereo-ao";
  return t;
}

}  // namespace

std::vector<Technique> hbao_plus() {
  return {over_depth(), over_peeled_layers(over_depth()), over_stochastic_depth(over_depth()), multiview(), stereo_ao(),
          // Each eye uses its own hidden depths.
          over_two_eyes(over_stochastic_depth(over_depth()), "hbao_plus_stereo")};
}

}  // namespace gloam::techniques
