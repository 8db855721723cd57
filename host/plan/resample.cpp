#include "plan/resample.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/layouts.h"
#include "resample/params.h"

namespace gloam {
namespace {

std::string reduced_name(const std::string& plane, int resolution) { return fmt::format("{}@{}", plane, resolution); }

/// Name of the kernel for a plane with these components.
std::string kernel_for(const std::string& kernel, const std::string& plane) {
  using Components = std::vector<std::string>;
  static const std::vector<std::pair<Components, std::string>> endings = {
      {{""}, ""}, {{"x", "y", "z"}, "_vector"}, {{"r", "g", "b"}, "_color"}, {{"r", "g", "b", "a"}, "_color_alpha"}};
  const Components components = plane_kind(plane).components;
  for (const auto& [known, ending] : endings) {
    if (known == components) return kernel + ending;
  }
  throw Error("'{}' has the components {}, which cannot be computed at a lower resolution", plane,
              enumerate(components));
}

/// The pass that takes every n-th pixel of a full-resolution plane or stack.
Pass subsample(const std::string& plane, const Plan& plan) {
  const int resolution = plan.resolution;
  Pass pass{.name = "subsample " + plane, .defines = {{"SCALE", resolution}}, .scale = resolution};
  pass.reads = {{"source", plane}};
  const auto stack = plan.stacks.find(plane);
  if (stack == plan.stacks.end()) {
    pass.kernel = kernel_for("subsample", plane);
    pass.writes = {{"result", reduced_name(plane, resolution)}};
  } else {
    const int layers = int(stack->second.size());
    pass.kernel = "subsample_stack";
    pass.defines.emplace_back("SOURCE_LAYERS", layers);
    pass.writes = {{"result", reduced_name(plane, resolution), layers}};
  }
  return pass;
}

Pass upsample(const std::string& plane, int resolution) {
  return {.name = "upsample " + plane,
          .kernel = kernel_for("joint_upsample", plane),
          .reads = {{"source", reduced_name(plane, resolution)},
                    {"low_depth", reduced_name("depth", resolution)},
                    {"low_normal", reduced_name("normal", resolution)},
                    "depth",
                    "normal"},
          .writes = {{"result", plane}},
          .defines = {{"SCALE", resolution},
                      {"OUTSIDE", int(plane_kind(plane).outside)},
                      {"UNIT_INTERVAL", plane_kind(plane).meaning == PlaneKind::unit_interval}},
          .can_skip = true};
}

/// Upsamples from the reduced pixels of both views, so that the views agree where both see a surface.
Pass upsample_of_both(const std::string& plane, int resolution) {
  Pass pass = upsample(plane, resolution);
  pass.kernel = "joint_upsample_of_both";
  pass.can_skip = false;
  pass.defines.insert(pass.defines.end(), {{"TWO_VIEWS", 1}, {"COMPONENTS", int(plane_kind(plane).components.size())}});
  for (const Binding& other : {Binding("other_source", reduced_name(plane, resolution)),
                               Binding("other_depth", reduced_name("depth", resolution)),
                               Binding("other_normal", reduced_name("normal", resolution))})
    pass.reads.push_back(from(From::other_view, other));
  return pass;
}

/// Rewrites the passes of a plan one by one.
class Reduction {
 public:
  Reduction(const Plan& plan, const ParameterValues& values) : plan_(plan), values_(values) {}

  void add(const PlannedPass& planned) { passes.push_back(planned); }

  void add_reduced(PlannedPass planned) {
    for (Binding& binding : planned.pass.reads) rename(binding);
    for (Binding& binding : planned.pass.writes) {
      made_.insert(binding.plane);
      agreed_[binding.plane] = planned.pass.views_agree;
      rename(binding);
    }
    planned.pass.scale *= plan_.resolution;
    planned.scale = plan_.resolution;
    passes.push_back(std::move(planned));
  }

  void add_outputs() {
    for (const std::string& output : plan_.outputs) {
      if (made_.count(output) == 0) continue;
      if (contains(resampling().reads, output))
        throw UsageError("{}: '{}' guides upsampling, so it needs every pixel; use {}", plan_.technique, output,
                         option("resolution", "full"));
      if (is_stack(output))
        throw UsageError("{}: '{}' holds layers, which cannot be upsampled; use {}", plan_.technique, output,
                         option("resolution", "full"));
      for (const std::string& guide : resampling().reads) need(guide);
      const auto pass_for = agreed_[output] ? upsample_of_both : upsample;
      passes.push_back({&resampling(), pass_for(output, plan_.resolution), values_});
    }
  }

  /// Names, at the low resolution, of the outputs that are made there.
  std::vector<std::string> reduced_outputs() const {
    std::vector<std::string> outputs = plan_.outputs;
    for (std::string& output : outputs) {
      if (made_.count(output)) output = reduced_name(output, plan_.resolution);
    }
    return outputs;
  }

  std::vector<PlannedPass> passes;

 private:
  /// Ensures that a plane exists at the low resolution: if no pass makes it there, it is subsampled.
  void need(const std::string& plane) {
    if (!made_.insert(plane).second) return;
    passes.push_back({&resampling(), subsample(plane, plan_), values_, plan_.resolution});
  }

  void rename(Binding& binding) {
    need(binding.plane);
    binding.plane = reduced_name(binding.plane, plan_.resolution);
  }

  const Plan& plan_;
  const ParameterValues& values_;
  std::set<std::string> made_;          ///< planes made at the low resolution
  std::map<std::string, bool> agreed_;  ///< for these planes, whether two views agree
};

/// The passes that outputs are made by, from the planes at hand.
std::vector<PlannedPass> passes_to(std::vector<std::string> needed, const std::vector<std::string>& at_hand,
                                   const std::vector<PlannedPass>& passes) {
  std::vector<PlannedPass> left;
  for (auto planned = passes.rbegin(); planned != passes.rend(); ++planned) {
    const auto is_written = [&](const std::string& plane) { return writes(planned->pass, plane); };
    if (std::none_of(needed.begin(), needed.end(), is_written)) continue;
    for (const Binding& read : planned->pass.reads)
      if (!contains(at_hand, read.plane)) add_new(needed, read.plane);
    left.insert(left.begin(), *planned);
  }
  return left;
}

/// Whether a technique makes a stack. If nobody asked for it, it is made for the technique that reads it, at the same resolution.
bool makes_stack(const Technique& technique) {
  return std::any_of(technique.writes.begin(), technique.writes.end(),
                     [](const std::string& plane) { return is_stack(plane); });
}

}  // namespace

const Technique& resampling() {
  static const Technique technique = {.name = "resample",
                                      .summary = "every n-th pixel, and back by joint bilateral upsampling",
                                      .paper = "Kopf, Cohen, Lischinski, Uyttendaele 2007",
                                      .source = "resample/resample.cl",
                                      .reads = {"depth", "normal"},
                                      .parameters = ResampleParams::table()};
  return technique;
}

void reduce(Plan& plan, const std::vector<const Technique*>& techniques, const ParameterValues& values,
            bool is_upsampled) {
  Reduction reduction(plan, values);
  for (PlannedPass& planned : plan.passes) {
    const bool is_asked_for = std::find(techniques.begin(), techniques.end(), planned.technique) != techniques.end();
    if (is_asked_for || makes_stack(*planned.technique))
      reduction.add_reduced(std::move(planned));
    else
      reduction.add(planned);
  }
  if (is_upsampled)
    reduction.add_outputs();
  else
    plan.outputs = reduction.reduced_outputs();
  plan.passes = std::move(reduction.passes);
}

std::optional<Upsampling> upsampling_of(const Plan& plan) {
  Upsampling left{plan, {}};
  for (const std::string& output : plan.outputs) left.given.push_back(reduced_name(output, plan.resolution));
  const auto is_made_there = [&](const std::string& plane) {
    return std::any_of(plan.passes.begin(), plan.passes.end(),
                       [&](const PlannedPass& planned) { return writes(planned.pass, plane); });
  };
  if (plan.resolution == 1 || !std::all_of(left.given.begin(), left.given.end(), is_made_there)) return {};
  left.plan.passes = passes_to(plan.outputs, left.given, plan.passes);
  const std::set<std::string> read = planes_of(left.plan);
  std::erase_if(left.plan.inputs, [&](const std::string& input) { return !read.contains(input); });
  std::erase_if(left.plan.stacks, [&](const auto& stack) { return !read.contains(stack.first); });
  left.plan.inputs.insert(left.plan.inputs.end(), left.given.begin(), left.given.end());
  return left;
}

}  // namespace gloam
