#include "plan/settings.h"

#include <algorithm>
#include <utility>

#include "base/lists.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "plan/resample.h"
#include "plan/temporal.h"
#include "plan/wanted.h"

namespace gloam {
namespace {

/// The technique that a setting is for, empty for all, and its parameter: "bilateral.radius", "radius".
std::pair<std::string, std::string> parts_of(const std::string& setting) {
  const size_t dot = setting.find('.');
  if (dot == std::string::npos) return {"", setting};
  return {setting.substr(0, dot), setting.substr(dot + 1)};
}

/// Applies the settings. A setting that reaches no planned technique is an error.
void apply(const PlanRequest& request, const Techniques& order, const std::string& main,
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
    const auto [only, bare] = parts_of(name);
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

void set_default_radius(double radius, const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t i = 0; i < order.size(); ++i) {
    for (const Parameter& p : order[i]->parameters) {
      if (is_radius(p)) values[i].set(p.name, fmt::format("{}", float(radius)), order[i]->name);
    }
  }
}

/// Sets the values that a technique gives to its follower.
void set_followers(const Techniques& order, std::vector<ParameterValues>& values) {
  const auto set = [&](const Technique& technique, size_t follower) {
    for (const auto& [name, value] : technique.then_with) values[follower].set(name, value, order[follower]->name);
  };
  for (const Technique* technique : order)
    for (size_t i = 0; i < order.size(); ++i)
      if (filters_extra_of(*order[i], *technique)) set(*technique, i);
  // Of two techniques that a filter may follow, the one that it follows anyway decides, not the one whose extra it could make.
  for (const Technique* technique : order)
    for (size_t i = 0; i < order.size(); ++i)
      if (order[i]->name == technique->then) set(*technique, i);
}

/// A follower inherits the radius of the technique that it follows, and so does accumulation over time.
void inherit(const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t from = 0; from < order.size(); ++from) {
    for (size_t to = from + 1; to < order.size(); ++to) {
      if (order[from]->then.empty() && !is_accumulating(*order[to])) continue;
      if (order[to] != &resampling() && !reads_from(*order[to], *order[from])) continue;
      for (const Parameter& p : order[from]->parameters) {
        if (values[to].has(p.name)) values[to].set(p.name, values[from].text(p.name), order[to]->name);
      }
    }
  }
}

/// A technique that makes layers makes as many as are asked for, by parameters of the same name.
void pass_on_to_stacks(const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t reader = 0; reader < order.size(); ++reader) {
    for (size_t maker = 0; maker < reader; ++maker) {
      const bool makes_its_layers = std::any_of(
          order[maker]->writes.begin(), order[maker]->writes.end(),
          [&](const std::string& plane) { return is_stack(plane) && contains(order[reader]->reads, plane); });
      if (!makes_its_layers) continue;
      for (const Parameter& p : order[reader]->parameters) {
        if (values[maker].has(p.name)) values[maker].set(p.name, values[reader].text(p.name), order[maker]->name);
      }
    }
  }
}

/// A mask shares parameters of the same name, such as the radius, with the technique that it restricts.
void pass_on_to_mask(const Techniques& order, const Technique& restricted, const std::string& mask,
                     std::vector<ParameterValues>& values) {
  const size_t asks = size_t(std::find(order.begin(), order.end(), &restricted) - order.begin());
  if (asks == order.size()) return;
  for (size_t maker = 0; maker < order.size(); ++maker) {
    if (!contains(order[maker]->writes, mask)) continue;
    for (const Parameter& p : restricted.parameters) {
      if (values[maker].has(p.name)) values[maker].set(p.name, values[asks].text(p.name), order[maker]->name);
    }
  }
}

}  // namespace

std::vector<ParameterValues> values_of(const PlanRequest& request, const Techniques& order, const std::string& main,
                                       const Technique* restricted, const std::string& mask) {
  std::vector<ParameterValues> values;
  for (const Technique* t : order) values.emplace_back(t->parameters);
  if (request.radius) set_default_radius(*request.radius, order, values);
  set_followers(order, values);
  // Applied twice: a follower's inherited values are then set, and settings for the follower itself override them.
  apply(request, order, main, values);
  inherit(order, values);
  pass_on_to_stacks(order, values);
  if (restricted) pass_on_to_mask(order, *restricted, mask, values);
  apply(request, order, main, values);
  return values;
}

std::vector<std::string> reads_of(const Technique& technique, const PlanRequest& request) {
  if (!technique.reads_with) return technique.reads;
  ParameterValues values(technique.parameters);
  for (const auto& [name, value] : request.settings) {
    const auto [only, bare] = parts_of(name);
    if ((only.empty() || only == technique.name) && values.has(bare)) values.set(bare, value, technique.name);
  }
  return technique.reads_with(values);
}

}  // namespace gloam
