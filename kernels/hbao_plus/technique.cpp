#include "gloam/technique.h"

#include "hbao_plus/params.h"

namespace gloam::techniques {
namespace {

std::vector<Pass> passes(const HbaoPlusParams& p) {
  Pass estimate{"estimate",
                "hbao_plus_estimate",
                {"depth", "normal"},
                {"ao_raw"},
                {{"DIRECTIONS", p.directions}, {"STEPS", p.steps}, {"POWER", p.power}, {"JITTER", p.jitter}}};
  if (p.falloff == HbaoPlusParams::falloff_values::none) estimate.defines.push_back({"NO_FALLOFF", 1});
  return {estimate};
}

}  // namespace

std::vector<Technique> hbao_plus() {
  return {{
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
      .passes = passes_of(passes),
  }};
}

}  // namespace gloam::techniques
