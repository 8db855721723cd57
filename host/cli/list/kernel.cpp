#include "base/lists.h"
#include "cli/list/techniques.h"
#include "gloam/error.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "run/kernels.h"

namespace gloam::cli {

void print_kernel(const std::string& label) {
  const Technique& technique = find_technique(label.substr(0, label.find('/')));
  const Plan plan = make_plan({.outputs = {technique.name}}, all_plane_names(16), "");
  std::vector<std::string> labels;
  for (const PlannedPass& planned : plan.passes) {
    add_new(labels, planned.label());
    if (planned.label() != label) continue;
    std::string constants;
    for (const auto& [name, value] : planned.pass.defines) constants += fmt::format(" -D {}={}", name, value);
    fmt::print("// {}, compiled with{} and what device and run add, such as -D LANES=8\n{}", label, constants,
               kernel_text(planned, Layouts(plan, Layout(1, 1))));
    return;
  }
  throw UsageError("no kernel '{}'{}; {} has {}", label, suggestion(label, labels), technique.name, enumerate(labels));
}

}  // namespace gloam::cli
