#include "technique/stereo.h"

#include <algorithm>
#include <utility>

#include "gloam/planes.h"
#include "technique/ambient_occlusion.h"

namespace gloam {
namespace {

using Filter = StereoChoices::Filter;

Pass visibility(const StereoChoices& c) {
  Pass pass{.name = "visibility",
            .kernel = "stereo_visibility",
            .reads = {"depth", from(From::other_view, {"other_depth", "depth"})},
            .writes = {"stereo_depth"}};
  if (c.reproject) pass.writes.push_back("newly_visible");
  if (c.near_half_occluded()) pass.writes.push_back("half_occluded");
  return pass;
}

/// The pass on the eye that the other eye's estimate reads.
Pass half_occlusion(const StereoChoices& c) {
  return {.name = "half-occlusion",
          .kernel = "stereo_half_occlusion",
          .reads = {{"depth", "stereo_depth"}},
          .writes = {"half_occluded"},
          .on = c.reproject ? on_view(1 - c.primary) : On::every_view};
}

/// The estimate from both eyes: it also reads the same planes of the other eye, except the normals.
Pass from_both(Pass estimate, const std::string& kernel) {
  estimate.kernel = kernel;
  estimate.reads.front().plane = "stereo_depth";
  const std::vector<Binding> own = estimate.reads;
  for (const Binding& read : own) {
    if (read.plane != "normal" && read.plane != "newly_visible")
      estimate.reads.push_back(from(From::other_view, {"other_" + read.argument, read.plane, read.layers}));
  }
  return estimate;
}

Pass reprojection(const std::string& raw, const StereoChoices& c) {
  return {.name = "reproject",
          .kernel = "stereo_reproject",
          .reads = {{"depth", "stereo_depth"},
                    "normal",
                    from(From::other_view, {"other_depth", "stereo_depth"}),
                    from(From::other_view, {"other_normal", "normal"}),
                    from(From::other_view, {"other", raw})},
          .writes = {{"result", raw}, "newly_visible"},
          .defines = {{"NO_BACK_CHECK", !c.back_check}},
          .on = on_view(1 - c.primary)};
}

/// The estimate for pixels that only the second eye sees.
Pass newly_visible(Pass estimate, const std::string& both, const StereoChoices& c) {
  estimate.reads.push_back("newly_visible");
  Pass pass = from_both(std::move(estimate), both + "_list");
  pass.name = "newly visible";
  pass.defines.emplace_back("ESTIMATE_MONO", !c.estimate_both);
  pass.on = on_view(1 - c.primary);
  return pass;
}

/// Makes each pass also write the sum of its weights, times that of the pass before.
void keep_weights(std::vector<Pass>& passes) {
  for (size_t i = 0; i < passes.size(); ++i) {
    Pass& pass = passes[i];
    pass.kernel = "bilateral_weighted";
    if (i > 0) pass.reads.insert(pass.reads.begin() + 1, Binding("source_weights", passes[i - 1].writes.back().plane));
    pass.writes.push_back({"result_weights", "weights_of_" + pass.writes.front().plane});
    pass.defines.emplace_back("WITH_SOURCE_WEIGHTS", i > 0);
  }
}

Pass blend(const Pass& last, const std::string& result) {
  Pass pass{.name = "blend",
            .kernel = "stereo_blend",
            .reads = {{"source", last.writes[0].plane}, {"source_weights", last.writes[1].plane}, "depth", "normal"},
            .writes = {{"result", result}},
            .defines = last.defines,
            .views_agree = true};
  for (const Binding& other :
       {Binding("other_source", last.writes[0].plane), Binding("other_weights", last.writes[1].plane),
        Binding("other_depth", "depth"), Binding("other_normal", "normal")})
    pass.reads.push_back(from(From::other_view, other));
  return pass;
}

/// Sets a default: the filter is part of the technique, with its own settings.
void set_initial(ParameterList& parameters, const std::string& name, const std::string& value) {
  for (Parameter& p : parameters) {
    if (p.name == name) p.initial = std::stod(value);
  }
}

/// The plane that a filter makes of raw AO or light: "indirect" of "indirect_raw".
std::string filtered(const std::string& raw) { return raw.substr(0, raw.rfind("_raw")); }

}  // namespace

Technique over_two_eyes(Technique mono, ParameterList parameters,
                        std::function<std::vector<Pass>(const ParameterValues&)> passes) {
  Technique t = std::move(mono);
  if (t.variant.of.empty()) t.variant.of = t.name;
  t.variant.both_eyes = true;
  t.summary = t.name + " for two eyes that agree on what both of them see";
  t.name.insert(0, "stereo-");
  t.paper += "; for two eyes Shi, Billeter, Eisemann 2022";
  t.views = 2;
  t.writes = t.outputs;
  t.default_for.clear();
  t.may_read.clear();
  t.effect = {};
  t.extras.clear();
  t.read_for_extras.clear();
  t.parameters = std::move(parameters);
  for (const auto& [name, value] : std::exchange(t.then_with, {})) set_initial(t.parameters, name, value);
  t.then.clear();
  t.passes = std::move(passes);
  return t;
}

std::vector<Pass> stereo_filter_passes(Filter filter, int taps, const std::string& raw, const std::string& result) {
  if (filter == Filter::mono) return bilateral_passes(taps, false, raw, result);
  std::vector<Pass> passes = bilateral_passes(taps, filter == Filter::stereo2d, raw, result + "@one_eye");
  keep_weights(passes);
  passes.push_back(blend(passes.back(), result));
  return passes;
}

std::vector<Pass> stereo_passes(std::vector<Pass> mono, const std::string& both, const StereoChoices& c) {
  Pass estimate = std::move(mono.back());
  const std::string raw = estimate.writes.front().plane;
  estimate.extras.clear();
  estimate.may_read.clear();
  mono.pop_back();
  std::vector<Pass> passes = std::move(mono);
  if (c.estimate_both || c.reproject) passes.push_back(visibility(c));
  passes.push_back(c.estimate_both ? from_both(estimate, both) : estimate);
  if (c.near_half_occluded()) {
    passes.back().reads.push_back(from(From::other_view, {"other_half_occluded", "half_occluded"}));
    passes.insert(passes.end() - 1, half_occlusion(c));
  }
  if (c.reproject) {
    passes.back().on = on_view(c.primary);
    passes.push_back(reprojection(raw, c));
    passes.push_back(newly_visible(estimate, both, c));
  }
  for (Pass& pass : stereo_filter_passes(c.filter, c.half_width, raw, filtered(raw))) passes.push_back(std::move(pass));
  estimate.defines.emplace_back("COMPONENTS", int(plane_kind(raw).components.size()));
  for (Pass& pass : passes) {
    if (!estimate.source.empty()) pass.source = estimate.source;
    // The whole program needs the defines of its estimate, and the components of what it makes.
    for (const auto& define : estimate.defines) {
      if (std::find(pass.defines.begin(), pass.defines.end(), define) == pass.defines.end())
        pass.defines.push_back(define);
    }
    pass.defines.insert(
        pass.defines.end(),
        {{"STEREO", 1}, {"WITH_PIXEL_LIST", c.reproject}, {"WITH_HALF_OCCLUSION", c.near_half_occluded()}});
  }
  return passes;
}

}  // namespace gloam
