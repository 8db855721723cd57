#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "technique/ambient_occlusion.h"

#define MULTIRES_PARAMS(P)                                                                     \
  REACH_PARAMS(P)                                                                              \
  P(int, levels, 5, 1, 8, "", "resolutions: the whole one, a half, a quarter, ...")            \
  P(int, samples, 10, 1, 512, "", "samples per pixel of each resolution")                      \
  OBSCURANCE_BIAS(P)                                                                           \
  OBSCURANCE_STRENGTH(P)                                                                       \
  OBSCURANCE_FALLOFF(P)                                                                        \
  P(choice, combine, maximum, (maximum, maximum_and_mean),                                     \
    "how resolutions are combined: the largest occlusion, or that and the mean of all")        \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                       \
    "distance from the tangent plane at which a pixel of a lower resolution no longer counts") \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians",                                  \
    "angle between normals at which a pixel of a lower resolution no longer counts")

PARAMS(MultiresParams, MULTIRES_PARAMS)

namespace gloam::techniques {
namespace {

/// The name of a plane at a level; the part before the @ tells its meaning (planes.h).
std::string at(const std::string& plane, int level) {
  return level == 0 ? plane : plane + "@multires" + std::to_string(level);
}

Pass subsample_to(int level) {
  return {.name = "subsample " + std::to_string(level),
          .kernel = "multires_subsample",
          .reads = {{"depth", at("depth", level - 1)}, {"normal", at("normal", level - 1)}},
          .writes = {{"low_depth", at("depth", level)}, {"low_normal", at("normal", level)}},
          .defines = {{"SCALE", 2}},
          .scale = 1 << level};
}

Pass estimate_at(int level, const MultiresParams& p) {
  const bool has_coarser = level < p.levels - 1;
  const bool has_mean = p.combine == MultiresParams::combine_values::maximum_and_mean;
  Pass pass{.name = "estimate " + std::to_string(level),
            .kernel = "multires_estimate",
            .defines = {{"LEVEL", level},
                        {"LEVELS", p.levels},
                        {"COARSER", has_coarser},
                        {"SAMPLES", p.samples},
                        {"WITH_MEAN", has_mean},
                        {"NO_FALLOFF", p.falloff == MultiresParams::falloff_values::none},
                        {"JITTER", p.jitter},
                        {"OUTSIDE_OPEN", p.outside == MultiresParams::outside_values::open},
                        {"SCALE", 2}},
            .scale = 1 << level};
  if (has_coarser) {
    pass.reads.push_back({"low_most", at("multires_most", level + 1)});
    if (has_mean) pass.reads.push_back({"low_sum", at("multires_sum", level + 1)});
    pass.reads.push_back({"low_depth", at("depth", level + 1)});
    pass.reads.push_back({"low_normal", at("normal", level + 1)});
  }
  pass.reads.push_back({"depth", at("depth", level)});
  pass.reads.push_back({"normal", at("normal", level)});
  if (level == 0) {
    // Masks are used at full resolution only: the lower ones are little work.
    pass.can_skip = true;
    pass.writes.push_back("ao_raw");
  } else {
    pass.writes.push_back({"most_found", at("multires_most", level)});
    if (has_mean) pass.writes.push_back({"sum_found", at("multires_sum", level)});
  }
  return pass;
}

std::vector<Pass> passes(const MultiresParams& p) {
  std::vector<Pass> all;
  for (int level = 1; level < p.levels; ++level) all.push_back(subsample_to(level));
  for (int level = p.levels - 1; level >= 0; --level) all.push_back(estimate_at(level, p));
  return all;
}

}  // namespace

std::vector<Technique> multires() {
  Technique t = ambient_occlusion("multires", "ambient occlusion from few samples at each of several resolutions",
                                  "Hoang, Low 2012", "multires/multires.cl");
  t.parameters = MultiresParams::table();
  t.presets = {{"low", {{"samples", "5"}}},
               {"medium", {{"samples", "10"}}},
               {"high", {{"samples", "20"}}},
               {"ultra", {{"samples", "40"}}}};
  t.converged = {{"samples", "512"}};
  t.passes = passes_of(passes);
  // At full resolution; the lower ones add at most a third.
  t.samples = value_of_samples;
  return {t};
}

}  // namespace gloam::techniques
