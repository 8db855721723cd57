#include "plan/adaptive.h"

#include <algorithm>
#include <iterator>

#include "adaptive/params.h"
#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/mask.h"
#include "plan/resample.h"

namespace gloam {
namespace {

constexpr int base_resolution = 4;
constexpr int pixels_of_tile = 4;  // of the base pass, along each axis
// A multiple of 16: each row of lanes lies in one tile, so that no pixel is estimated twice.
constexpr int tile = base_resolution * pixels_of_tile;
static_assert(tile % 16 == 0);

void check_adaptive(const Plan& plan, const Technique& technique, const std::string& preset) {
  if (plan.resolution != 1)
    throw UsageError("{}: works at full resolution; leave out {}", option("adaptive", preset), option("resolution"));
  if (!contains(technique.writes, "ao_raw"))
    throw UsageError("{}: varies the samples of ambient occlusion, and {} makes {}; leave {} out",
                     option("adaptive", preset), technique.name, enumerate(technique.writes), option("adaptive"));
  const bool reads_stack = std::any_of(technique.reads.begin(), technique.reads.end(), is_stack);
  if (technique.views > 1 || reads_stack)
    throw UsageError("{}: {} reads {}, which a base pass does not; leave {} out", option("adaptive", preset),
                     technique.name, reads_stack ? "further layers" : "two views", option("adaptive"));
}

ParameterValues with_preset(const Technique& technique, ParameterValues values, const std::string& name) {
  const auto preset =
      std::find_if(technique.presets.begin(), technique.presets.end(), [&](const Preset& p) { return p.name == name; });
  if (preset == technique.presets.end()) {
    std::vector<std::string> names;
    for (const Preset& p : technique.presets) names.push_back(p.name);
    throw UsageError("{}: {} has no such preset{}; {}", option("adaptive", name), technique.name,
                     suggestion(name, names), names.empty() ? "it has none" : "it has " + enumerate(names));
  }
  for (const auto& [parameter, value] : preset->settings) values.set(parameter, value, technique.name);
  return values;
}

/// A technique's passes as planned, with the values of a preset and without extras.
std::vector<PlannedPass> passes_with(const Technique& technique, const ParameterValues& values) {
  std::vector<PlannedPass> planned;
  for (Pass& pass : technique.passes(values)) {
    if (!pass.writes.empty()) planned.push_back({&technique, std::move(pass), values});
  }
  return planned;
}

template <typename Item>
void append(std::vector<Item>& to, std::vector<Item> items) {
  std::move(items.begin(), items.end(), std::back_inserter(to));
}

/// Null if the plan does not use the technique.
const ParameterValues* values_of(const Plan& plan, const Technique& technique) {
  const auto planned = std::find_if(plan.passes.begin(), plan.passes.end(),
                                    [&](const PlannedPass& p) { return p.technique == &technique; });
  return planned == plan.passes.end() ? nullptr : &planned->values;
}

/// The passes of all techniques at a low resolution with few samples. Their last plane tells where AO varies.
std::vector<PlannedPass> base_passes(const Plan& plan, const std::vector<const Technique*>& techniques) {
  Plan base = plan;
  base.passes.clear();
  base.outputs.clear();
  base.resolution = base_resolution;
  for (const Technique* technique : techniques) {
    const ParameterValues* values = values_of(plan, *technique);
    if (!values) continue;
    append(
        base.passes,
        passes_with(*technique, technique == techniques.front() ? with_preset(*technique, *values, "low") : *values));
  }
  reduce(base, techniques, ParameterValues(resampling().parameters));
  return std::move(base.passes);
}

PlannedPass tiles_pass(const std::string& ao, const ParameterValues& values) {
  Pass pass{.name = "tiles", .kernel = "important_tiles", .defines = {{"PIXELS", pixels_of_tile}}, .scale = tile};
  pass.reads = {{"ao", ao}};
  pass.writes = {{"important", "important"}};
  return {&adapting(), std::move(pass), values};
}

/// The plane of bits by which a pass skips pixels; empty if it skips none.
std::string bits_of(const Pass& pass) {
  const auto wanted = std::find_if(pass.reads.begin(), pass.reads.end(),
                                   [](const Binding& binding) { return binding.argument == "wanted"; });
  return wanted == pass.reads.end() ? "" : wanted->plane;
}

/// Whether a pass computes the pixels that the estimate listed.
bool computes_list_of(const PlannedPass& planned, const PlannedPass& estimate) {
  const auto is_listed = [&](const Binding& read) {
    return std::any_of(estimate.pass.writes.begin(), estimate.pass.writes.end(),
                       [&](const Binding& written) { return written.starts_empty && written.plane == read.plane; });
  };
  return planned.technique == estimate.technique &&
         std::any_of(planned.pass.reads.begin(), planned.pass.reads.end(), is_listed);
}

/// A planned pass with other settings, for the pixels that the planned one skips.
PlannedPass of_the_rest(const PlannedPass& planned, const ParameterValues& values) {
  std::vector<PlannedPass> passes = passes_with(*planned.technique, values);
  const auto same = std::find_if(passes.begin(), passes.end(),
                                 [&](const PlannedPass& p) { return p.pass.name == planned.pass.name; });
  PlannedPass rest = *same;
  rest.pass.name += " of the rest";
  rest.pass.reads = planned.pass.reads;
  rest.pass.writes = planned.pass.writes;
  for (const auto& define : planned.pass.defines) {
    if (define.first.rfind("WITH_", 0) == 0) rest.pass.defines.push_back(define);
  }
  if (rest.pass.can_skip) keep_skipped(rest.pass);
  return rest;
}

}  // namespace

const Technique& adapting() {
  static const Technique technique = {.name = "adaptive",
                                      .summary = "where AO varies, by a base pass",
                                      .paper = "after McLaren 2016",
                                      .source = "adaptive/adaptive.cl",
                                      .parameters = AdaptiveParams::table()};
  return technique;
}

bool is_estimate(const Pass& pass) { return pass.can_skip && pass.footprint.is_wide; }

void adapt(Plan& plan, const std::vector<const Technique*>& techniques, const std::string& preset,
           const ParameterValues& values) {
  const Technique& technique = *techniques.front();
  check_adaptive(plan, technique, preset);
  const auto estimate = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& p) {
    return p.technique == &technique && is_estimate(p.pass) && p.pass.scale == 1;
  });
  if (estimate == plan.passes.end())
    throw UsageError("{}: {} has no estimate that can skip pixels; leave {} out", option("adaptive", preset),
                     technique.name, option("adaptive"));
  const ParameterValues values_of_rest = with_preset(technique, estimate->values, preset);
  PlannedPass rest = of_the_rest(*estimate, values_of_rest);
  const auto next = std::find_if_not(estimate + 1, plan.passes.end(),
                                     [&](const PlannedPass& p) { return computes_list_of(p, *estimate); });
  std::vector<PlannedPass> passes(plan.passes.begin(), estimate);
  append(passes, base_passes(plan, techniques));
  passes.push_back(tiles_pass(passes.back().pass.writes.front().plane, values));
  passes.push_back(bits_pass("important", tile, bits_of(estimate->pass), "wanted.important", "wanted.smooth"));
  PlannedPass important = *estimate;
  skip_by(important.pass, "wanted.important");
  skip_by(rest.pass, "wanted.smooth");
  passes.push_back(important);
  append(passes, std::vector<PlannedPass>(estimate + 1, next));
  passes.push_back(rest);
  for (auto listed = estimate + 1; listed != next; ++listed) passes.push_back(of_the_rest(*listed, values_of_rest));
  append(passes, std::vector<PlannedPass>(next, plan.passes.end()));
  plan.passes = std::move(passes);
  plan.rest = "wanted.smooth";
}

}  // namespace gloam
