#include "plan/temporal.h"

#include <algorithm>

#include "base/lists.h"
#include "temporal/params.h"

namespace gloam {
namespace {

/// Renames the raw AO in a pass of the technique: what this frame alone shows.
void use_own_frame(Pass& pass) {
  for (std::vector<Binding>* list : {&pass.reads, &pass.writes}) {
    for (Binding& binding : *list) {
      if (binding.plane == "ao_raw") binding.plane = "ao_raw.now";
    }
  }
}

constexpr int tile = 16;
static_assert(tile % 16 == 0, "each row of lanes lies in one tile");
// Of what moves, in tiles: the radius of AO on the screen is rarely longer.
constexpr int reach = 16;

bool writes_raw(const Pass& pass) {
  return std::any_of(pass.writes.begin(), pass.writes.end(),
                     [](const Binding& binding) { return binding.plane == "ao_raw"; });
}

/// For the planes of the step itself, which no technique makes.
Binding own(const std::string& name) { return {name, "temporal_" + name}; }

Pass reproject_pass(const Plan& plan) {
  Pass pass{.name = "reproject", .kernel = "temporal_reproject", .source = "temporal/reproject.cl"};
  pass.reads = {"depth", "normal"};
  for (const char* plane : {"history_ao", "history_depth", "history_frames"})
    pass.reads.push_back(from(From::frame_before, plane));
  if (contains(plan.inputs, "motion")) {
    pass.reads.emplace_back("motion");
    pass.defines.emplace_back("WITH_MOTION", 1);
  }
  pass.writes = {own("before"), own("before_frames"), own("moved")};
  return pass;
}

/// The last one writes the distance of each tile from what moves.
std::vector<Pass> tile_passes() {
  const Defines defines = {{"TILE", tile}, {"REACH", reach}};
  const auto pass = [&](const char* name, const char* kernel, Binding from, Binding to) {
    return Pass{.name = name,
                .kernel = kernel,
                .source = "temporal/moving.cl",
                .reads = {std::move(from)},
                .writes = {std::move(to)},
                .defines = defines,
                .scale = tile};
  };
  return {pass("moving", "moving_tiles", own("moved"), own("moving")),
          pass("across", "distance_across", own("moving"), {"tiles_away", "temporal_across"}),
          pass("down", "distance_down", own("across"), own("tiles_away"))};
}

Pass accumulate_pass() {
  return {.name = "accumulate",
          .kernel = "temporal_accumulate",
          .source = "temporal/accumulate.cl",
          .reads = {{"now", "ao_raw.now"}, "depth", own("before"), own("before_frames"), own("tiles_away")},
          .writes = {"ao_raw", "frames"},
          .defines = {{"TILE", tile}, {"REACH", reach}},
          .footprint = {.columns = 2, .rows = 2}};
}

std::vector<std::string> with_form_for_sequences() {
  std::vector<std::string> names;
  for (const Technique& technique : registry()) {
    if (!technique.over_time.empty()) names.push_back(technique.name);
  }
  return names;
}

}  // namespace

const Technique& accumulating() {
  static const Technique technique = {
      .name = "temporal",
      .summary = "mean over the frames of a sequence",
      .paper = "Yang, Liu, Salvi 2020",
      .reads = {"ao_raw", "depth", "normal", "history_ao", "history_depth", "history_frames"},
      .may_read = {"motion"},
      .parameters = TemporalParams::table()};
  return technique;
}

std::vector<std::string> over_time(std::vector<std::string> outputs) {
  for (std::string& output : outputs) {
    for (const Technique& t : registry()) {
      if (t.name == output && !t.over_time.empty()) output = t.over_time;
    }
  }
  return outputs;
}

bool accumulates_by_itself(const Technique& technique) { return contains(technique.reads, "history"); }

bool can_accumulate(const Technique& technique) {
  return accumulates_by_itself(technique) || !technique.over_time.empty() || contains(technique.writes, "ao_raw");
}

void check_temporal(const PlanRequest& request) {
  const std::vector<std::string> names = technique_names();
  const std::string& name = request.outputs.front();
  if (request.outputs.size() > 1 || !contains(names, name))
    throw UsageError("--temporal: takes one technique, not {}", enumerate(request.outputs));
  const Technique& technique = find_technique(name);
  if (!can_accumulate(technique) && contains(technique.writes, "reflection"))
    throw UsageError("--temporal: {} has no form for sequences; {} has", name, enumerate(with_form_for_sequences()));
  if (!can_accumulate(technique))
    throw UsageError("--temporal: {} makes neither raw ambient occlusion nor reflections; leave it out", name);
  if (request.resolution != 1)
    throw UsageError(
        "accumulation over time (--temporal, --history): works at full resolution; leave out --resolution");
  if (!request.adaptive.empty() && request.adaptive != "none")
    throw UsageError(
        "accumulation over time (--temporal, --history): each pixel gets as many samples; leave out --adaptive");
  if (!request.mask.empty() && contains(technique.writes, "ao_raw"))
    throw UsageError("accumulation over time (--temporal, --history): goes on from whole images; leave out --only");
}

bool takes_frames(PlanRequest& request) {
  if (!contains(outputs_of(find_technique(request.outputs.front())), "frames"))
    return std::erase(request.only, "frames") > 0;
  return false;
}

void accumulate(Plan& plan, const Technique& technique, const ParameterValues& values, bool with_frames) {
  // A technique for two eyes filters by itself: its later passes read the mean.
  auto after = plan.passes.end();
  for (auto planned = plan.passes.begin(); planned != plan.passes.end(); ++planned) {
    if (planned->technique == &technique && writes_raw(planned->pass)) after = planned + 1;
  }
  for (auto planned = plan.passes.begin(); planned != after; ++planned) {
    if (planned->technique == &technique) use_own_frame(planned->pass);
  }
  std::vector<Pass> passes = tile_passes();
  passes.insert(passes.begin(), reproject_pass(plan));
  passes.push_back(accumulate_pass());
  for (Pass& pass : passes) after = plan.passes.insert(after, {&accumulating(), std::move(pass), values}) + 1;
  if (with_frames || contains(plan.outputs, "ao_raw")) add_new(plan.outputs, "frames");
}

}  // namespace gloam
