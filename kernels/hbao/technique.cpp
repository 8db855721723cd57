#include <cmath>

#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"

#define HBAO_PARAMS(P)                                                                                          \
  REACH_PARAMS(P)                                                                                               \
  P(float, bias, 0.1f, 0, 1.5f, "radians", "occluders at a smaller angle above the tangent plane do not count") \
  P(int, directions, 2, 1, 64, "", "directions searched per pixel")                                             \
  P(int, steps, 9, 1, 256, "", "samples along each direction")                                                  \
  P(choice, falloff, quadratic, (quadratic, linear, none), "how an occluder fades towards the radius")          \
  P(choice, weighting, uniform, (uniform, cosine),                                                              \
    "weight of a direction: the same for all, or its cosine to the normal")

PARAMS(HbaoParams, HBAO_PARAMS)

namespace gloam::techniques {
namespace {

using Falloff = HbaoParams::falloff_values;
using Weighting = HbaoParams::weighting_values;

std::vector<Pass> passes(const HbaoParams& p) {
  Pass estimate = ambient_occlusion_estimate(p, "hbao_estimate",
                                             {{"DIRECTIONS", p.directions},
                                              {"STEPS", p.steps},
                                              {"NO_FALLOFF", p.falloff == Falloff::none},
                                              {"LINEAR_FALLOFF", p.falloff == Falloff::linear},
                                              {"COSINE_WEIGHTED", p.weighting == Weighting::cosine}});
  estimate.extras = {"bent_normal", "cone"};
  return {std::move(estimate)};
}

double weight_of(const HbaoParams& p, double distance) {
  if (p.falloff == Falloff::none) return 1;
  return p.falloff == Falloff::linear ? 1 - distance : 1 - distance * distance;
}

/// The estimate's limit for many samples, as an integral over directions: a sweep outwards first meets each elevation where a
/// ray of that elevation hits. Where all directions have the same weight, a cosine-weighted one counts by 1 / cosine.
double contribution(const HbaoParams& p, double cosine, double distance) {
  if (distance >= 1 || cosine <= std::sin(double(p.bias))) return 0;
  return weight_of(p, distance) * (p.weighting == Weighting::cosine ? 1 : 0.5 / cosine);
}

Technique over_depth() {
  Technique t = ambient_occlusion("hbao", "ambient occlusion from the horizon along directions on the screen",
                                  "Bavoil, Sainz, Dimitrov 2008", "hbao/hbao.cl");
  t.extras = {"bent_normal", "cone"};
  t.parameters = HbaoParams::table();
  t.presets = {{"low", {{"directions", "2"}, {"steps", "4"}}},
               {"medium", {{"directions", "2"}, {"steps", "9"}}},
               {"high", {{"directions", "2"}, {"steps", "18"}}},
               {"ultra", {{"directions", "4"}, {"steps", "18"}}}};
  t.converged = {{"directions", "16"}, {"steps", "128"}};
  t.passes = passes_of(passes);
  t.recommended = "you want ambient occlusion in the least time";
  t.samples = directions_times_steps;
  t.contribution = contribution_of(contribution);
  return t;
}

}  // namespace

std::vector<Technique> hbao() {
  return {over_depth(), over_peeled_layers(over_depth()), over_stochastic_depth(over_depth())};
}

}  // namespace gloam::techniques
