#include "technique/stereo.h"

#include <algorithm>
#include <utility>

#include "gloam/planes.h"
#include "shared/stereo/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam {
namespace {

bool is_from_both(const StereoParams& p) { return p.estimate == StereoParams::estimate_values::stereo; }
bool reprojects(const StereoParams& p) { return p.reproject != StereoParams::reproject_values::off; }

/// Whether the other eye is used near surfaces that only it sees, not for every pixel.
bool is_near_half_occluded(const StereoParams& p) {
  return is_from_both(p) && p.other_eye == StereoParams::other_eye_values::near;
}

Pass visibility(const StereoParams& p) {
  Pass pass{.name = "visibility",
            .kernel = "stereo_visibility",
            .reads = {"depth", from(From::other_view, {"other_depth", "depth"})},
            .writes = {"stereo_depth"}};
  if (reprojects(p)) pass.writes.push_back("newly_visible");
  if (is_near_half_occluded(p)) pass.writes.push_back("half_occluded");
  return pass;
}

/// The pass on the eye that the other eye's estimate reads.
Pass half_occlusion(const StereoParams& p) {
  return {.name = "half-occlusion",
          .kernel = "stereo_half_occlusion",
          .reads = {{"depth", "stereo_depth"}},
          .writes = {"half_occluded"},
          .on = reprojects(p) ? on_view(1 - p.primary) : On::every_view};
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

Pass reprojection(const std::string& raw, const StereoParams& p) {
  return {.name = "reproject",
          .kernel = "stereo_reproject",
          .reads = {{"depth", "stereo_depth"},
                    "normal",
                    from(From::other_view, {"other_depth", "stereo_depth"}),
                    from(From::other_view, {"other_normal", "normal"}),
                    from(From::other_view, {"other", raw})},
          .writes = {{"result", raw}, "newly_visible"},
          .defines = {{"NO_BACK_CHECK", p.reproject == StereoParams::reproject_values::no_back_check}},
          .on = on_view(1 - p.primary)};
}

/// The estimate for pixels that only the second eye sees.
Pass newly_visible(Pass estimate, const std::string& both, const StereoParams& p) {
  estimate.reads.push_back("newly_visible");
  Pass pass = from_both(std::move(estimate), both + "_list");
  pass.name = "newly visible";
  pass.defines.emplace_back("ESTIMATE_MONO", !is_from_both(p));
  pass.on = on_view(1 - p.primary);
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

/// The filter of raw AO or light, which makes "indirect" of "indirect_raw".
std::vector<Pass> filter_of(const std::string& raw, const StereoParams& p) {
  using Filter = StereoParams::filter_values;
  const std::string result = raw.substr(0, raw.rfind("_raw"));
  if (p.filter == Filter::mono) return bilateral_passes(p.half_width, false, raw, result);
  return stereo_filter_passes(p.half_width, p.filter == Filter::stereo2d, raw, result);
}

std::vector<Pass> stereo_passes(std::vector<Pass> mono, const std::string& both, const StereoParams& p) {
  Pass estimate = std::move(mono.back());
  const std::string raw = estimate.writes.front().plane;
  estimate.extras.clear();
  estimate.may_read.clear();
  mono.pop_back();
  std::vector<Pass> passes = std::move(mono);
  if (is_from_both(p) || reprojects(p)) passes.push_back(visibility(p));
  passes.push_back(is_from_both(p) ? from_both(estimate, both) : estimate);
  if (is_near_half_occluded(p)) {
    passes.back().reads.push_back(from(From::other_view, {"other_half_occluded", "half_occluded"}));
    passes.insert(passes.end() - 1, half_occlusion(p));
  }
  if (reprojects(p)) {
    passes.back().on = on_view(p.primary);
    passes.push_back(reprojection(raw, p));
    passes.push_back(newly_visible(estimate, both, p));
  }
  for (Pass& pass : filter_of(raw, p)) passes.push_back(std::move(pass));
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
        {{"STEREO", 1}, {"WITH_PIXEL_LIST", reprojects(p)}, {"WITH_HALF_OCCLUSION", is_near_half_occluded(p)}});
  }
  return passes;
}

}  // namespace

Technique over_two_eyes(Technique mono, const std::string& both) {
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
  t.parameters = t.parameters + StereoParams::table();
  for (const auto& [name, value] : std::exchange(t.then_with, {})) set_initial(t.parameters, name, value);
  t.then.clear();
  t.passes = [one_eye = t.passes, both](const ParameterValues& values) {
    return stereo_passes(one_eye(values), both, values.as<StereoParams>());
  };
  return t;
}

std::vector<Pass> stereo_filter_passes(int half_width, bool is_square, const std::string& raw,
                                       const std::string& result) {
  const std::string one_eye = result + "@one_eye";
  std::vector<Pass> passes = is_square ? bilateral_passes(half_width, true, raw, one_eye)
                                       : bilateral_passes_along_axes(half_width, raw, one_eye);
  keep_weights(passes);
  passes.push_back(blend(passes.back(), result));
  return passes;
}

}  // namespace gloam
