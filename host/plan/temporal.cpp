#include "plan/temporal.h"

#include <algorithm>
#include <map>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/layouts.h"
#include "temporal/params.h"

namespace gloam {
namespace {

/// A plane that is accumulated, and the one that the frame before leaves of it.
struct Accumulated {
  std::string raw, history;
};

const std::vector<Accumulated>& all_accumulated() {
  static const std::vector<Accumulated> planes = {{"ao_raw", "history_ao"}, {"indirect_raw", "history_indirect"}};
  return planes;
}

/// Of a technique; none for others.
const Accumulated* accumulated_of(const Technique& technique) {
  for (const Accumulated& plane : all_accumulated()) {
    if (contains(technique.writes, plane.raw)) return &plane;
  }
  return nullptr;
}

Technique accumulating(const Accumulated& plane) {
  return {.name = "temporal",
          .summary = "mean over the frames of a sequence",
          .paper = "Yang, Liu, Salvi 2020",
          .reads = {plane.raw, "depth", "normal", plane.history, "history_depth", "history_frames"},
          .may_read = {"motion"},
          .parameters = TemporalParams::table()};
}

/// By the plane that is accumulated.
const std::map<std::string, Technique>& all_accumulating() {
  static const std::map<std::string, Technique> techniques = [] {
    std::map<std::string, Technique> made;
    for (const Accumulated& plane : all_accumulated()) made.emplace(plane.raw, accumulating(plane));
    return made;
  }();
  return techniques;
}

std::string of_this_frame(const std::string& raw) { return raw + "@now"; }
std::string of_frames_before(const std::string& raw) { return raw + "@before"; }

/// Renames the raw plane in a pass of the technique: what this frame alone shows.
void use_own_frame(Pass& pass, const std::string& raw) {
  for (std::vector<Binding>* list : {&pass.reads, &pass.writes}) {
    for (Binding& binding : *list) {
      if (binding.plane == raw) binding.plane = of_this_frame(raw);
    }
  }
}

Defines components_of(const Accumulated& plane) {
  return {{"COMPONENTS", int(plane_kind(plane.raw).components.size())}};
}

constexpr int moved_tile = 16;
static_assert(moved_tile % 16 == 0, "each row of lanes lies in one tile");
// Of what moves, in tiles: the radius of AO on the screen is rarely longer.
constexpr int reach = 16;

/// For the planes of the step itself, which no technique makes.
Binding own(const std::string& name) { return {name, "temporal_" + name}; }

Pass reproject_pass(const Plan& plan, const Accumulated& plane) {
  Pass pass{.name = "reproject", .kernel = "temporal_reproject", .source = "temporal/reproject.cl"};
  pass.reads = {"depth", "normal"};
  for (const Binding& history :
       {Binding("history", plane.history), Binding("history_depth"), Binding("history_frames")})
    pass.reads.push_back(from(From::frame_before, history));
  pass.defines = components_of(plane);
  if (contains(plan.inputs, "motion")) {
    pass.reads.emplace_back("motion");
    pass.defines.emplace_back("WITH_MOTION", 1);
  }
  pass.writes = {{"before", of_frames_before(plane.raw)}, own("before_frames"), own("before_count"), own("moved")};
  return pass;
}

/// The last one writes the distance of each tile from what moves.
std::vector<Pass> tile_passes() {
  const Defines defines = {{"TILE", moved_tile}, {"REACH", reach}};
  const auto pass = [&](const char* name, const char* kernel, Binding from, Binding to) {
    return Pass{.name = name,
                .kernel = kernel,
                .source = "temporal/moving.cl",
                .reads = {std::move(from)},
                .writes = {std::move(to)},
                .defines = defines,
                .scale = moved_tile};
  };
  return {pass("moving", "moving_tiles", own("moved"), own("moving")),
          pass("across", "distance_across", own("moving"), {"tiles_away", "temporal_across"}),
          pass("down", "distance_down", own("across"), own("tiles_away"))};
}

Pass accumulate_pass(const Accumulated& plane) {
  Pass pass{.name = "accumulate",
            .kernel = "temporal_accumulate",
            .source = "temporal/accumulate.cl",
            .reads = {{"now", of_this_frame(plane.raw)},
                      "depth",
                      {"before", of_frames_before(plane.raw)},
                      own("before_frames"),
                      own("before_count"),
                      own("tiles_away")},
            .writes = {{"result", plane.raw}, "frames"},
            .defines = components_of(plane),
            .footprint = {.columns = 2, .rows = 2}};
  pass.defines.insert(pass.defines.end(), {{"TILE", moved_tile}, {"REACH", reach}});
  return pass;
}

std::vector<std::string> with_form_for_sequences() {
  std::vector<std::string> names;
  for (const Technique& technique : registry()) {
    if (!technique.over_time.empty()) names.push_back(technique.name);
  }
  return names;
}

}  // namespace

const Technique& accumulating(const Technique& technique) {
  return all_accumulating().at(accumulated_of(technique)->raw);
}

bool is_accumulating(const Technique& technique) {
  return std::any_of(all_accumulating().begin(), all_accumulating().end(),
                     [&](const auto& known) { return &technique == &known.second; });
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
  return accumulates_by_itself(technique) || !technique.over_time.empty() || accumulated_of(technique);
}

namespace {

/// Throws UsageError for AO beside what is accumulated: it would be that of one frame.
void check_no_ao_beside(const PlanRequest& request, const Technique& technique) {
  for (const std::string& plane : request.with) {
    if (contains(technique.extras, "ao_raw") && (plane == "ao" || plane == "ao_raw"))
      throw UsageError("{}: {} does not accumulate it over time; leave it out, and run bitmask {} for it",
                       option("with", plane), technique.name, option("temporal"));
  }
}

}  // namespace

void check_temporal(const PlanRequest& request) {
  const std::vector<std::string> names = technique_names();
  const std::string& name = request.outputs.front();
  if (request.outputs.size() > 1 || !contains(names, name))
    throw UsageError("{}: takes one technique, not {}", option("temporal"), enumerate(request.outputs));
  const Technique& technique = find_technique(name);
  if (!can_accumulate(technique) && contains(technique.writes, "reflection"))
    throw UsageError("{}: {} has no form for sequences; {} has", option("temporal"), name,
                     enumerate(with_form_for_sequences()));
  if (!can_accumulate(technique))
    throw UsageError("{}: {} makes neither raw ambient occlusion or indirect light nor reflections; leave it out",
                     option("temporal"), name);
  if (request.resolution != 1)
    throw UsageError("accumulation over time ({}, {}): works at full resolution; leave out {}", option("temporal"),
                     option("history"), option("resolution"));
  if (!request.adaptive.empty() && request.adaptive != "none")
    throw UsageError("accumulation over time ({}, {}): each pixel gets as many samples; leave out {}",
                     option("temporal"), option("history"), option("adaptive"));
  if (!request.only.empty() && accumulated_of(technique))
    throw UsageError("accumulation over time ({}, {}): goes on from whole images; leave out {}", option("temporal"),
                     option("history"), option("only"));
  check_no_ao_beside(request, technique);
}

bool takes_frames(PlanRequest& request) {
  if (!contains(outputs_of(find_technique(request.outputs.front())), "frames"))
    return std::erase(request.only_outputs, "frames") > 0;
  return false;
}

void accumulate(Plan& plan, const Technique& technique, const ParameterValues& values, bool with_frames) {
  const Accumulated& accumulated = *accumulated_of(technique);
  // A technique for two eyes filters by itself: its later passes read the mean.
  auto after = plan.passes.end();
  for (auto planned = plan.passes.begin(); planned != plan.passes.end(); ++planned) {
    if (planned->technique == &technique && writes(planned->pass, accumulated.raw)) after = planned + 1;
  }
  for (auto planned = plan.passes.begin(); planned != after; ++planned) {
    if (planned->technique == &technique) use_own_frame(planned->pass, accumulated.raw);
  }
  std::vector<Pass> passes = tile_passes();
  passes.insert(passes.begin(), reproject_pass(plan, accumulated));
  passes.push_back(accumulate_pass(accumulated));
  for (Pass& pass : passes) after = plan.passes.insert(after, {&accumulating(technique), std::move(pass), values}) + 1;
  if (with_frames || contains(plan.outputs, accumulated.raw)) add_new(plan.outputs, "frames");
}

}  // namespace gloam
