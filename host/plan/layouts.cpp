#include "plan/layouts.h"

#include <algorithm>

#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {

bool writes(const Pass& pass, const std::string& plane) {
  return std::any_of(pass.writes.begin(), pass.writes.end(),
                     [&](const Binding& written) { return written.plane == plane; });
}

std::set<std::string> planes_of(const Plan& plan) {
  std::set<std::string> planes;
  for (const PlannedPass& p : plan.passes) {
    for (const Binding& b : p.pass.reads) planes.insert(b.plane);
    for (const Binding& b : p.pass.writes) planes.insert(b.plane);
  }
  return planes;
}

std::set<std::string> lists_of(const Plan& plan) {
  std::set<std::string> lists;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& written : planned.pass.writes) {
      if (written.starts_empty) lists.insert(written.plane);
    }
  }
  return lists;
}

namespace {

/// The largest number of what writes a plane. Two techniques may make stacks of the same name, one after the other.
size_t most_written(const Plan& plan, const std::string& plane, int Binding::*number) {
  int most = 0;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& binding : planned.pass.writes) {
      if (binding.plane == plane) most = std::max(most, binding.*number);
    }
  }
  return size_t(most);
}

}  // namespace

size_t layers_in_buffer(const Plan& plan, const std::string& name) {
  if (const auto stack = plan.stacks.find(name); stack != plan.stacks.end()) return stack->second.size();
  return std::max<size_t>(most_written(plan, name, &Binding::layers), 1);
}

size_t more_rows_in_buffer(const Plan& plan, const std::string& name) {
  return most_written(plan, name, &Binding::more_rows);
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

unsigned long long bytes_of_buffer(const Plan& plan, const Layouts& layouts, const std::string& name) {
  const Layout layout = layouts.of(name);
  return layers_in_buffer(plan, name) * layout.bytes() +
         more_rows_in_buffer(plan, name) * size_t(layout.pitch) * sizeof(float);
}

unsigned long long bytes_of(const Plan& plan, const Layouts& layouts, const std::string& name) {
  return plane_kind(name).components.size() * bytes_of_buffer(plan, layouts, name);
}

bool needs_two_views(const Plan& plan) {
  return std::any_of(plan.passes.begin(), plan.passes.end(),
                     [](const PlannedPass& planned) { return planned.technique->views == 2; });
}

namespace {

/// The first pass that runs on key views, or on those between them; null if there is none.
const PlannedPass* pass_of_key_views(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.pass.on == On::key_views || planned.pass.on == On::views_between) return &planned;
  }
  return nullptr;
}

}  // namespace

bool looks_into_key_views(const Plan& plan) { return pass_of_key_views(plan) != nullptr; }

int key_view_spacing(const Plan& plan, size_t views) {
  const PlannedPass* const planned = views < 2 ? nullptr : pass_of_key_views(plan);
  return planned ? planned->technique->key_views(planned->values) : 1;
}

size_t views_at_once(const Plan& plan, size_t views) {
  if (needs_two_views(plan)) return 2;
  return key_view_spacing(plan, views) > 1 ? std::min<size_t>(views, 3) : 1;  // a view between two key views
}

}  // namespace gloam
