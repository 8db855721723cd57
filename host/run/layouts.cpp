#include "run/layouts.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam {

std::set<std::string> planes_of(const Plan& plan) {
  std::set<std::string> planes;
  for (const PlannedPass& p : plan.passes) {
    for (const Binding& b : p.pass.reads) planes.insert(b.plane);
    for (const Binding& b : p.pass.writes) planes.insert(b.plane);
  }
  return planes;
}

size_t layers_in_buffer(const Plan& plan, const std::string& name) {
  if (const auto stack = plan.stacks.find(name); stack != plan.stacks.end()) return stack->second.size();
  // Two techniques may make one of the same name, one after the other.
  int layers = 1;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& binding : planned.pass.writes) {
      if (binding.plane == name) layers = std::max(layers, binding.layers);
    }
  }
  return size_t(layers);
}

int Layouts::scale_of(const std::string& plane) const {
  const auto known = scales_.find(plane);
  return known == scales_.end() ? 1 : known->second;
}

int other_scale(const PlannedPass& planned, const Layouts& layouts) {
  int other = 0;
  for (const std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (const Binding& binding : *list) {
      const int scale = layouts.scale_of(binding.plane);
      if (binding.from == From::other_view || scale == planned.pass.scale || scale == other) continue;
      if (other != 0)
        throw Error("{}: binds planes of three resolutions (1/{}, 1/{}, 1/{}); two are allowed", planned.label(),
                    planned.pass.scale, other, scale);
      other = scale;
    }
  }
  return other;
}

}  // namespace gloam
