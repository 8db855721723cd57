#include "base/lists.h"
#include "cli/list/techniques.h"
#include "gloam/error.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "run/kernels.h"

namespace gloam::cli {
namespace {

/// Plans of a technique for a frame that has every plane: its default, and with what plans add, as far as it can be had.
std::vector<Plan> plans_with_all_passes(const std::string& technique) {
  std::vector<Plan> plans;
  for (PlanRequest request : std::vector<PlanRequest>{
           {}, {.resolution = 2}, {.only = "mask"}, {.preset = "high", .adaptive = "low"}, {.temporal = true}}) {
    request.outputs = {technique};
    try {
      plans.push_back(make_plan(request, all_plane_names(16), ""));
    } catch (const UsageError&) {
    }
  }
  return plans;
}

void print_text(const Plan& plan, const PlannedPass& planned) {
  std::string constants;
  for (const auto& [name, value] : planned.pass.defines) constants += fmt::format(" -D {}={}", name, value);
  fmt::print("// {}: {}, compiled with{} and what device and run add, such as -D LANES=8\n{}", planned.label(),
             planned.pass.kernel, constants, kernel_text(planned, Layouts(plan, Layout(1, 1))));
}

}  // namespace

void print_kernel(const std::string& label) {
  const std::string name = label.substr(0, label.find('/'));
  const bool is_technique = contains(technique_names(), name);
  std::vector<std::string> labels;
  for (const std::string& technique : is_technique ? std::vector{name} : technique_names()) {
    for (const Plan& plan : plans_with_all_passes(technique)) {
      for (const PlannedPass& planned : plan.passes) {
        if (planned.label() == label) return print_text(plan, planned);
        if (is_technique || planned.technique->name == name) add_new(labels, planned.label());
      }
    }
  }
  if (labels.empty()) find_technique(name);
  if (label == name) {
    for (const std::string& one : labels) fmt::print("{}\n", one);
    return;
  }
  throw UsageError("no kernel '{}'{}; {} has {}", label, suggestion(label, labels), name, enumerate(labels));
}

}  // namespace gloam::cli
