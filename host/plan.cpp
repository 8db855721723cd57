#include "gloam/plan.h"

#include <algorithm>
#include <set>

#include "gloam/planes.h"

namespace gloam {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

const std::vector<std::string>& outputs_of(const Technique& t) { return t.outputs.empty() ? t.writes : t.outputs; }

const Technique* technique_named(const std::string& name) {
  for (const Technique& t : registry()) {
    if (t.name == name) return &t;
  }
  return nullptr;
}

/// All planes that any technique writes, for suggestions.
std::vector<std::string> plane_and_technique_names() {
  std::vector<std::string> names = technique_names();
  for (const Technique& t : registry()) {
    for (const std::string& plane : t.writes) {
      if (!contains(names, plane)) names.push_back(plane);
    }
  }
  return names;
}

/// Walks back from outputs to planes at hand.
class Walk {
 public:
  Walk(const PlanRequest& request, const std::vector<std::string>& available)
      : request_(request), available_(available) {}

  void ask_for(const std::string& output) {
    if (const Technique* technique = technique_named(output)) {
      prefer(*technique);
      for (const std::string& plane : outputs_of(*technique)) add_output(plane);
      return;
    }
    const Technique* maker = maker_of(output, "");
    if (!maker && !contains(available_, output)) {
      throw UsageError("nothing makes '{}'{} (gloam list techniques shows what there is)", output,
                       suggestion(output, plane_and_technique_names()));
    }
    if (maker && !contains(preferred_, maker->name)) prefer(*maker);
    add_output(output);
  }

  void walk() {
    for (const std::string& output : plan.outputs) need(output, "");
  }

  Plan plan;
  std::vector<std::string> missing;
  std::vector<const Technique*> order;

 private:
  void add_output(const std::string& plane) {
    if (!contains(plan.outputs, plane)) plan.outputs.push_back(plane);
  }

  void prefer(const Technique& technique) {
    preferred_.push_back(technique.name);
    const std::string next = request_.then.empty() ? technique.then : request_.then;
    if (next == "none") {
      // Without a follower only what the technique itself writes is left of its outputs.
      dropped_ = outputs_of(technique);
      return;
    }
    if (!next.empty()) preferred_.push_back(find_technique(next).name);
  }

  /// Preferred techniques first, then any that does not itself need the plane.
  const Technique* maker_of(const std::string& plane, const std::string& asking) const {
    for (const std::string& name : preferred_) {
      const Technique* t = technique_named(name);
      if (t->name != asking && contains(t->writes, plane)) return t;
    }
    for (const Technique& t : registry()) {
      if (t.name != asking && contains(t.writes, plane)) return &t;
    }
    return nullptr;
  }

  void need(const std::string& plane, const std::string& asking) {
    if (contains(made_, plane) || contains(plan.inputs, plane) || contains(missing, plane)) return;
    const Technique* maker = maker_of(plane, asking);
    const bool wanted = maker && contains(preferred_, maker->name);
    if (contains(available_, plane) && !wanted) {
      plan.inputs.push_back(plane);
      if (maker && !contains(being_made_, maker->name)) {
        plan.skipped.emplace_back(maker->name, fmt::format("the file has '{}'", plane));
      }
      return;
    }
    if (!maker || contains(being_made_, maker->name)) {
      missing.push_back(plane);
      return;
    }
    schedule(*maker);
  }

  void schedule(const Technique& technique) {
    being_made_.push_back(technique.name);
    for (const std::string& plane : technique.reads) need(plane, technique.name);
    order.push_back(&technique);
    for (const std::string& plane : technique.writes) made_.push_back(plane);
  }

  const PlanRequest& request_;
  const std::vector<std::string>& available_;
  std::vector<std::string> preferred_, being_made_, made_, dropped_;

 public:
  void keep_only(const std::vector<std::string>& planes) {
    for (const std::string& plane : planes) {
      if (!contains(plan.outputs, plane)) {
        throw UsageError("{}: no output '{}'{}; there are {}", request_.outputs.front(), plane,
                         suggestion(plane, plan.outputs), enumerate(plan.outputs));
      }
    }
    if (!planes.empty()) plan.outputs = planes;
  }

  /// Outputs that only the dropped follower would have made.
  void drop_unmade_outputs() {
    std::erase_if(plan.outputs, [&](const std::string& plane) {
      if (!contains(dropped_, plane)) return false;
      for (const std::string& name : preferred_) {
        if (contains(technique_named(name)->writes, plane)) return false;
      }
      return true;
    });
  }
};

/// Every setting reaches at least one planned technique, or is an error.
void apply(const PlanRequest& request, const std::vector<const Technique*>& order, const std::string& main,
           std::vector<ParameterValues>& values) {
  const auto set_where_known = [&](const std::string& name, const std::string& value, const std::string& only) {
    bool known = false;
    for (size_t i = 0; i < order.size(); ++i) {
      if ((!only.empty() && order[i]->name != only) || !values[i].has(name)) continue;
      values[i].set(name, value, order[i]->name);
      known = true;
    }
    return known;
  };
  if (!request.preset.empty()) {
    bool found = false;
    std::vector<std::string> names;
    for (const Technique* t : order) {
      for (const Preset& preset : t->presets) {
        names.push_back(preset.name);
        if (preset.name != request.preset) continue;
        found = true;
        for (const auto& [name, value] : preset.settings) set_where_known(name, value, t->name);
      }
    }
    if (!found) {
      throw UsageError("{}: no preset '{}'{}; {}", main, request.preset, suggestion(request.preset, names),
                       names.empty() ? "it has none" : "it has " + enumerate(names));
    }
  }
  for (const auto& [name, value] : request.settings) {
    const size_t dot = name.find('.');
    const std::string only = dot == std::string::npos ? "" : name.substr(0, dot);
    const std::string bare = dot == std::string::npos ? name : name.substr(dot + 1);
    if (set_where_known(bare, value, only)) continue;
    std::vector<std::string> known;
    for (const Technique* t : order) {
      for (const Parameter& p : t->parameters) {
        if (!contains(known, p.name)) known.push_back(p.name);
      }
    }
    throw UsageError("{}: no parameter '{}'{}{}", main, name, suggestion(bare, known),
                     known.empty() ? "; it has none" : fmt::format("; there are {}", enumerate(known)));
  }
}

/// A follower works on the same radius as the technique it follows, unless told otherwise.
void inherit(const std::vector<const Technique*>& order, std::vector<ParameterValues>& values) {
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t j = 0; j < order.size(); ++j) {
      if (order[i]->then.empty() || i == j || order[j]->name == order[i]->name) continue;
      if (order[j]->reads.end() == std::find_first_of(order[j]->reads.begin(), order[j]->reads.end(),
                                                      order[i]->writes.begin(), order[i]->writes.end()))
        continue;
      for (const Parameter& p : order[i]->parameters) {
        if (values[j].has(p.name)) values[j].set(p.name, values[i].text(p.name), order[j]->name);
      }
    }
  }
}

}  // namespace

Plan make_plan(const PlanRequest& request, const std::vector<std::string>& available, const std::string& holds) {
  Walk walk(request, available);
  for (const std::string& output : request.outputs) walk.ask_for(output);
  walk.drop_unmade_outputs();
  walk.keep_only(request.only);
  walk.walk();
  Plan plan = std::move(walk.plan);
  plan.technique = technique_named(request.outputs.front()) ? request.outputs.front()
                   : walk.order.empty()                     ? request.outputs.front()
                                                            : walk.order.front()->name;
  if (!walk.missing.empty()) {
    std::vector<std::string> quoted;
    for (const std::string& plane : walk.missing) quoted.push_back("'" + plane + "'");
    throw MissingPlanes(
        fmt::format("{}: needs {}, and {} (see docs/gbuffer.md)", plan.technique, enumerate(quoted), holds),
        walk.missing);
  }
  std::vector<ParameterValues> values;
  for (const Technique* t : walk.order) values.emplace_back(t->parameters);
  // Twice: what a follower inherits is already set, and what is said of the follower itself wins.
  apply(request, walk.order, plan.technique, values);
  inherit(walk.order, values);
  apply(request, walk.order, plan.technique, values);
  for (size_t i = 0; i < walk.order.size(); ++i) {
    for (Pass& pass : walk.order[i]->passes(values[i]))
      plan.passes.push_back({walk.order[i], std::move(pass), values[i]});
  }
  for (const std::string& plane : available) {
    if (!contains(plan.inputs, plane)) plan.skipped.emplace_back(plane, "no pass reads it; not decoded");
  }
  if (contains(plan.inputs, "depth"))
    plan.depends_on_pixels.push_back("background: recognised when the depth is decoded");
  if (contains(plan.inputs, "normal")) {
    plan.depends_on_pixels.push_back("normal space: compared with the depth where neither file nor flag says it");
  }
  return plan;
}

}  // namespace gloam
