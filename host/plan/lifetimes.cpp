#include "plan/lifetimes.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "base/lists.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// The first and the last pass that touch a plane, by their places in the plan.
struct Lifetime {
  std::string plane;
  size_t first, last;
};

/// Planes that are written before they are read, and whose values nobody asks for when all passes have run. In the order of their first pass.
std::vector<Lifetime> lifetimes(const Plan& plan) {
  std::vector<Lifetime> lives;
  std::set<std::string> kept(plan.inputs.begin(), plan.inputs.end());
  kept.insert(plan.outputs.begin(), plan.outputs.end());
  kept.insert({plan.wanted, plan.rest});
  kept.merge(lists_of(plan));
  const auto touch = [&](const std::string& plane, size_t pass, bool writes) {
    const auto known = std::find_if(lives.begin(), lives.end(), [&](const Lifetime& l) { return l.plane == plane; });
    if (known != lives.end()) {
      known->last = pass;
    } else if (!writes || is_stack(plane) || layers_in_buffer(plan, plane) > 1) {
      kept.insert(plane);
    } else {
      lives.push_back({plane, pass, pass});
    }
  };
  for (size_t k = 0; k < plan.passes.size(); ++k) {
    const Pass& pass = plan.passes[k].pass;
    for (const Binding& read : pass.reads) touch(read.plane, k, false);
    for (const Binding& written : pass.writes) touch(written.plane, k, true);
  }
  std::erase_if(lives, [&](const Lifetime& life) { return kept.contains(life.plane); });
  return lives;
}

}  // namespace

std::map<std::string, std::string> shared_memory(const Plan& plan, const Layouts& layouts) {
  std::map<std::string, std::string> shared;
  if (looks_into_key_views(plan)) return shared;
  const auto form = [&](const std::string& plane) {
    const PlaneKind kind = plane_kind(plane);
    return std::tuple(layouts.scale_of(plane), kind.components.size(), kind.outside);
  };
  std::vector<Lifetime> memories;  // named by the plane that each is made for; `last` is that of the latest plane in it
  for (const Lifetime& life : lifetimes(plan)) {
    const auto free = std::find_if(memories.begin(), memories.end(), [&](const Lifetime& memory) {
      return memory.last < life.first && form(memory.plane) == form(life.plane);
    });
    if (free == memories.end()) {
      memories.push_back(life);
    } else {
      shared[life.plane] = free->plane;
      free->last = life.last;
    }
  }
  return shared;
}

unsigned long long bytes_of_planes(const Plan& plan, const Layouts& layouts, bool in_place) {
  const std::map<std::string, std::string> shared = shared_memory(plan, layouts);
  unsigned long long bytes = 0;
  for (const std::string& name : planes_of(plan)) {
    const bool is_in_place = in_place && contains(plan.inputs, name) && plan.stacks.count(name) == 0;
    if (!is_in_place && !shared.contains(name)) bytes += bytes_of(plan, layouts, name);
  }
  return bytes;
}

}  // namespace gloam
