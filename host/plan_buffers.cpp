#include "plan_buffers.h"

#include <algorithm>

#include "gloam/planes.h"
#include "gloam/run.h"
#include "lists.h"
#include "resample.h"

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

unsigned long long bytes_of(const Plan& plan, const Layouts& layouts, const std::string& name) {
  return plane_kind(name).components.size() * layers_in_buffer(plan, name) * layouts.of(name).bytes();
}

int key_view_spacing(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.pass.on != Pass::Views::every) return planned.technique->key_views(planned.values);
  }
  return 1;
}

int key_view_spacing(const Plan& plan, size_t views) { return views > 1 ? key_view_spacing(plan) : 1; }

bool needs_two_views(const Plan& plan) {
  return std::any_of(plan.passes.begin(), plan.passes.end(),
                     [](const PlannedPass& planned) { return planned.technique->views == 2; });
}

/// Of views that look into one another: two, or a view between two key views.
size_t views_at_once(const Plan& plan, size_t views) {
  if (needs_two_views(plan)) return 2;
  return key_view_spacing(plan, views) > 1 ? std::min<size_t>(views, 3) : 1;
}

unsigned long long device_bytes(const Plan& plan, const Layout& layout, size_t views) {
  const Layouts layouts(plan, layout);
  unsigned long long bytes = 0;
  for (const std::string& name : planes_of(plan)) bytes += bytes_of(plan, layouts, name);
  return views_at_once(plan, views) * bytes;
}

unsigned long long bytes_beside_frame(const Plan& plan, const Layout& layout, size_t views, bool shares_memory) {
  const Layouts layouts(plan, layout);
  unsigned long long buffers = 0, results = 0;
  for (const std::string& name : planes_of(plan)) {
    const bool is_in_place = contains(plan.inputs, name) && plan.stacks.count(name) == 0;
    if (!is_in_place) buffers += bytes_of(plan, layouts, name);
  }
  for (const std::string& name : plan.outputs) results += bytes_of(plan, layouts, name);
  const size_t at_once = std::min(views_at_once(plan, views), views);
  // Results of the views before; those of the last ones are their buffers.
  return shares_memory ? at_once * buffers + (views - at_once) * results : views * results;
}

}  // namespace gloam
