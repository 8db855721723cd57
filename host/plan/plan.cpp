#include "gloam/plan.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/adaptive.h"
#include "plan/mask.h"
#include "plan/relevant_map.h"
#include "plan/resample.h"
#include "plan/settings.h"
#include "plan/stacks.h"
#include "plan/temporal.h"
#include "plan/walk.h"
#include "plan/wanted.h"

namespace gloam {
namespace {

/// The extras that a technique has to make: those asked for, and those that others read.
std::vector<std::string> extras_of(const Technique& technique, const std::vector<std::string>& outputs,
                                   const Walk& walk) {
  std::vector<std::string> extras = outputs;
  for (const auto& [maker, plane] : walk.extras) {
    if (maker == &technique) add_new(extras, plane);
  }
  return extras;
}

bool reads(const Pass& pass, const std::string& plane) {
  return std::any_of(pass.reads.begin(), pass.reads.end(), [&](const Binding& b) { return b.plane == plane; });
}

/// Adds those of the technique's extras to a pass's outputs, and what is read for them alone to its inputs.
void add_extras(Pass& pass, const Technique& technique, const std::vector<std::string>& asked_for) {
  for (const Binding& extra : pass.extras) {
    if (!contains(asked_for, extra.plane) && !contains(asked_for, extra.argument)) continue;
    for (const auto& [plane, read] : technique.read_for_extras) {
      if (plane == extra.plane && !reads(pass, read)) pass.reads.push_back(read.c_str());
    }
    pass.writes.push_back(extra);
    pass.defines.emplace_back("WITH_" + upper_case(extra.argument), 1);
  }
}

/// Adds the planes at hand of those that a pass may read.
void add_optional_reads(Pass& pass, const std::vector<std::string>& inputs) {
  for (const Binding& plane : pass.may_read) {
    if (!contains(inputs, plane.plane)) continue;
    pass.reads.push_back(plane);
    pass.defines.emplace_back("WITH_" + upper_case(plane.argument), 1);
  }
}

/// Leaves out the inputs that techniques may read and, with these settings, do not.
void leave_out_unread(Plan& plan, const Techniques& techniques) {
  std::erase_if(plan.inputs, [&](const std::string& input) {
    const bool is_optional = std::any_of(techniques.begin(), techniques.end(),
                                         [&](const Technique* t) { return contains(t->may_read, input); });
    const bool is_read = std::any_of(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& planned) {
      const std::vector<Binding>& reads = planned.pass.reads;
      return std::any_of(reads.begin(), reads.end(), [&](const Binding& read) { return read.plane == input; });
    });
    return is_optional && !is_read;
  });
}

/// Notes which planes of the frame are not read, and why. The layers of a stack are one entry.
void skip_the_rest(Plan& plan, const std::vector<std::string>& available) {
  std::vector<std::string> told;
  for (const std::string& plane : available) {
    if (contains(plan.inputs, plane)) continue;
    const std::optional<StackLayer> layer = stack_layer(plane);
    const bool computed = contains(plan.outputs, plane);
    const std::string name = layer && !computed ? layer->stack : plane;
    if (contains(told, name)) continue;
    told.push_back(name);
    plan.skipped.emplace_back(name, computed ? "asked for, so it is computed" : "no pass reads it; not decoded");
  }
}

std::vector<Pass> passes_of(const Technique& technique, const ParameterValues& values) {
  return technique.passes ? technique.passes(values) : std::vector<Pass>();
}

/// The techniques without the maker of the mask, which is made from all pixels before the techniques that it restricts.
Techniques without_maker(Techniques techniques, const std::string& mask) {
  std::erase_if(techniques, [&](const Technique* t) { return contains(t->writes, mask); });
  return techniques;
}

/// Throws UsageError for techniques that read motion at a lower resolution: motion is in pixels of the full image.
void check_full_resolution(const PlanRequest& request, const Techniques& techniques) {
  if (request.resolution == 1) return;
  for (const Technique* technique : techniques) {
    if (contains(technique->reads, "motion"))
      throw UsageError("{}: works at full resolution, as motion is in its pixels; leave out {}", technique->name,
                       option("resolution"));
  }
}

/// Adds what accumulation after a technique reads, but for what that makes.
void want_history(const Technique& technique, const std::vector<std::string>& available,
                  std::vector<std::string>& also) {
  const std::vector<std::string>& reads = accumulating(technique).reads;
  std::copy_if(reads.begin(), reads.end(), std::back_inserter(also),
               [&](const std::string& plane) { return !contains(technique.writes, plane); });
  if (contains(available, "motion")) also.push_back("motion");
}

/// Removes the passes that only repeat cells, so that the cells themselves are the output.
void put_out_cells(Plan& plan) {
  for (std::string& output : plan.outputs) {
    const auto repeats = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& planned) {
      return planned.pass.repeats_cells && planned.pass.writes.front().plane == output;
    });
    if (repeats == plan.passes.end()) continue;
    output = repeats->pass.reads.front().plane;
    plan.passes.erase(repeats);
  }
}

}  // namespace

const std::vector<std::string>& outputs_of(const Technique& technique) {
  return technique.outputs.empty() ? technique.writes : technique.outputs;
}

bool reads_from(const Technique& reader, const Technique& writer) {
  return std::any_of(reader.reads.begin(), reader.reads.end(),
                     [&](const std::string& plane) { return contains(writer.writes, plane); });
}

Plan make_plan(const PlanRequest& given, const std::vector<std::string>& available, const std::string& holds) {
  PlanRequest request = given;
  if (request.temporal) request.outputs = over_time(request.outputs);
  const bool asks_for_frames = request.temporal && takes_frames(request);
  Wanted wanted = wanted_by(request, available);
  const Techniques asked_for = wanted.makers;
  const Technique* elsewhere = want_elsewhere(request, wanted);
  const std::string mask = want_mask(wanted, request.only, available);
  const bool is_reduced = request.resolution > 1;
  std::vector<std::string> also = is_reduced ? resampling().reads : std::vector<std::string>();
  if (elsewhere) {
    also.insert(also.end(), elsewhere->reads.begin(), elsewhere->reads.end());
    std::copy_if(elsewhere->may_read.begin(), elsewhere->may_read.end(), std::back_inserter(also),
                 [&](const std::string& plane) { return contains(available, plane); });
  }
  if (request.temporal) check_temporal(request);
  const bool accumulates_after = request.temporal && !accumulates_by_itself(*asked_for.front());
  if (accumulates_after) want_history(*asked_for.front(), available, also);
  Walk walk(wanted, request, with_stacks(available), also, mask);
  check_full_resolution(request, walk.order);
  Plan plan;
  plan.technique = wanted.makers.empty() ? request.outputs.front() : wanted.makers.front()->name;
  take_inputs(plan, walk.inputs, available, walk.missing);
  if (!walk.missing.empty()) throw_missing(plan.technique, wanted, walk, holds);
  if (elsewhere) walk.order.insert(std::find(walk.order.begin(), walk.order.end(), asked_for.front()), elsewhere);
  if (is_adaptive(request)) walk.order.push_back(&adapting());
  if (accumulates_after) walk.order.push_back(&accumulating(*asked_for.front()));
  if (is_reduced) walk.order.push_back(&resampling());
  const Technique* restricted = mask.empty() || asked_for.empty() ? nullptr : asked_for.front();
  const std::vector<ParameterValues> values = values_of(request, walk.order, plan.technique, restricted, mask);
  for (size_t i = 0; i < walk.order.size(); ++i) {
    for (Pass& pass : passes_of(*walk.order[i], values[i])) {
      // What completes an extra of two estimates runs once, after both.
      if (pass.writes.empty() && walk.order[i] == elsewhere) continue;
      add_extras(pass, *walk.order[i], extras_of(*walk.order[i], wanted.outputs, walk));
      if (pass.writes.empty()) continue;
      add_optional_reads(pass, plan.inputs);
      define_layers(pass, plan, *walk.order[i]);
      plan.passes.push_back({walk.order[i], std::move(pass), values[i]});
    }
  }
  check_made_map(plan);
  trim_stacks(plan);
  plan.outputs = wanted.outputs;
  plan.resolution = request.resolution;
  if (is_reduced) reduce(plan, without_maker(asked_for, mask), values.back(), !request.as_cells);
  plan.mask = mask;
  if (!mask.empty())
    restrict_to_mask(plan, elsewhere ? Techniques{asked_for.front(), elsewhere} : asked_for, elsewhere);
  if (is_adaptive(request)) adapt(plan, without_maker(asked_for, mask), request.adaptive, values.back());
  if (accumulates_after)
    accumulate(plan, *asked_for.front(), values.back(), asks_for_frames || given.only_outputs.empty());
  if (request.as_cells) put_out_cells(plan);
  leave_out_unread(plan, walk.order);
  plan.skipped = walk.skipped;
  skip_the_rest(plan, available);
  if (contains(plan.inputs, "depth"))
    plan.depends_on_pixels.push_back("background: recognised when the depth is decoded");
  if (contains(plan.inputs, "normal")) {
    plan.depends_on_pixels.push_back("normal space: compared with the depth where neither file nor flag says it");
  }
  return plan;
}

std::map<std::string, int> plane_scales(const Plan& plan) {
  std::map<std::string, int> scales;
  for (const std::string& input : plan.inputs) scales.emplace(input, resolution_in(input));
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& b : planned.pass.reads) scales.emplace(b.plane, b.layers > 0 ? planned.scale : 1);
    for (const Binding& b : planned.pass.writes)
      scales.emplace(b.plane, b.layers > 0 && !b.as_launched ? planned.scale : planned.pass.scale);
  }
  return scales;
}

}  // namespace gloam
