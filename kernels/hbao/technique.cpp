#include "gloam/technique.h"

#include <cmath>

#include "hbao/params.h"

namespace gloam::techniques {
namespace {

using Falloff = HbaoParams::falloff_values;
using Weighting = HbaoParams::weighting_values;

Pass estimate_of(const HbaoParams& p) {
  return {.name = "estimate",
          .kernel = "hbao_estimate",
          .reads = {"depth", "normal"},
          .writes = {"ao_raw"},
          .defines = {{"DIRECTIONS", p.directions},
                      {"STEPS", p.steps},
                      {"JITTER", p.jitter},
                      {"NO_FALLOFF", p.falloff == Falloff::none},
                      {"LINEAR_FALLOFF", p.falloff == Falloff::linear},
                      {"COSINE_WEIGHTED", p.weighting == Weighting::cosine},
                      {"OUTSIDE_OPEN", p.outside == HbaoParams::outside_values::open}},
          .extras = {"bent_normal", "cone"}};
}

std::vector<Pass> passes(const HbaoParams& p) { return {estimate_of(p)}; }

/// The same with every layer of the peeled depth as an occluder.
std::vector<Pass> passes_over_layers(const HbaoParams& p) {
  Pass estimate = estimate_of(p);
  estimate.reads.push_back({"occluders", "peel"});
  return {estimate};
}

int samples(const ParameterValues& values) { return int(values.number("directions") * values.number("steps")); }

double weight_of(const HbaoParams& p, double distance) {
  if (p.falloff == Falloff::none) return 1;
  return p.falloff == Falloff::linear ? 1 - distance : 1 - distance * distance;
}

/// The estimate's limit for many samples, as an integral over directions: a sweep outwards meets each elevation first where
/// a ray of that elevation hits. Where all directions count alike, one of the cosine-weighted ones counts by 1 / cosine.
double contribution(const HbaoParams& p, double cosine, double distance) {
  if (distance >= 1 || cosine <= std::sin(double(p.bias))) return 0;
  return weight_of(p, distance) * (p.weighting == Weighting::cosine ? 1 : 0.5 / cosine);
}

Technique over_depth() {
  return {
      .name = "hbao",
      .summary = "ambient occlusion from the horizon along directions on the screen",
      .paper = "Bavoil, Sainz, Dimitrov 2008",
      .source = "hbao/hbao.cl",
      .reads = {"depth", "normal"},
      .writes = {"ao_raw"},
      .outputs = {"ao", "ao_raw"},
      .then = "bilateral",
      .then_with = {{"half_width", "2"}},
      .extras = {"bent_normal", "cone"},
      .parameters = HbaoParams::table(),
      .presets = {{"low", {{"directions", "2"}, {"steps", "4"}}},
                  {"medium", {{"directions", "2"}, {"steps", "9"}}},
                  {"high", {{"directions", "2"}, {"steps", "18"}}},
                  {"ultra", {{"directions", "4"}, {"steps", "18"}}}},
      .converged = {{"directions", "16"}, {"steps", "128"}},
      .passes = passes_of(passes),
      .samples = samples,
      .contribution = contribution_of(contribution),
  };
}

Technique over_layers() {
  Technique technique = over_depth();
  technique.name = "dp-hbao";
  technique.summary = "hbao over all peeled depth layers: the upper bound of what more layers can give";
  technique.paper = "Vermeer, Scandolo, Eisemann 2021";
  technique.reads.push_back("peel");
  technique.passes = passes_of(passes_over_layers);
  return technique;
}

}  // namespace

std::vector<Technique> hbao() { return {over_depth(), over_layers()}; }

}  // namespace gloam::techniques
