#include "gloam/technique.h"

#include "hbao_plus/params.h"

namespace gloam::techniques {
namespace {

Pass estimate_of(const HbaoPlusParams& p) {
  Pass estimate{"estimate",
                "hbao_plus_estimate",
                {"depth", "normal"},
                {"ao_raw"},
                {{"DIRECTIONS", p.directions},
                 {"STEPS", p.steps},
                 {"POWER", p.power},
                 {"JITTER", p.jitter},
                 {"OUTSIDE_OPEN", p.outside == HbaoPlusParams::outside_values::open}}};
  if (p.falloff == HbaoPlusParams::falloff_values::none) estimate.defines.push_back({"NO_FALLOFF", 1});
  return estimate;
}

std::vector<Pass> passes(const HbaoPlusParams& p) { return {estimate_of(p)}; }

/// The same with every layer of the peeled depth as an occluder.
std::vector<Pass> passes_over_layers(const HbaoPlusParams& p) {
  Pass estimate = estimate_of(p);
  estimate.reads.push_back({"occluders", "peel"});
  return {estimate};
}

int samples(const ParameterValues& values) { return int(values.number("directions") * values.number("steps")); }

/// The estimate's limit for many samples, as an integral over directions; `power` comes after it and is no part of it.
double contribution(const HbaoPlusParams& p, double cosine, double distance) {
  if (distance >= 1 || cosine <= p.bias) return 0;
  const double weight = p.falloff == HbaoPlusParams::falloff_values::none ? 1 : 1 - distance * distance;
  return p.strength * weight * (cosine - p.bias) / cosine;
}

Technique over_depth() {
  return {
      .name = "hbao+",
      .summary = "ambient occlusion: mean obscurance over directions x steps on the screen",
      .paper = "Bavoil, Sainz 2008; NVIDIA 2016",
      .source = "hbao_plus/hbao_plus.cl",
      .reads = {"depth", "normal"},
      .writes = {"ao_raw"},
      .outputs = {"ao", "ao_raw"},
      .then = "bilateral",
      .parameters = HbaoPlusParams::table(),
      .presets = {{"low", {{"directions", "4"}, {"steps", "4"}}},
                  {"medium", {{"directions", "8"}, {"steps", "4"}}},
                  {"high", {{"directions", "8"}, {"steps", "8"}}},
                  {"ultra", {{"directions", "16"}, {"steps", "16"}}}},
      .converged = {{"directions", "32"}, {"steps", "32"}},
      .passes = passes_of(passes),
      .samples = samples,
      .contribution = contribution_of(contribution),
  };
}

Technique over_layers() {
  Technique technique = over_depth();
  technique.name = "dp-hbao+";
  technique.summary = "hbao+ over all peeled depth layers: the upper bound of what more layers can give";
  technique.paper = "Vermeer, Scandolo, Eisemann 2021";
  technique.reads = {"depth", "normal", "peel"};
  technique.passes = passes_of(passes_over_layers);
  return technique;
}

}  // namespace

std::vector<Technique> hbao_plus() { return {over_depth(), over_layers()}; }

}  // namespace gloam::techniques
