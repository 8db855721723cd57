#include "auto/candidates.h"

#include <algorithm>

#include "auto/automatic.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "planner/goal.h"

namespace gloam {
namespace {

bool has_effect_for_displays(const std::string& name) {
  const std::vector<const Technique*> all = techniques_with_effects();
  return std::any_of(all.begin(), all.end(),
                     [&](const Technique* t) { return t->effect.for_displays && t->effect.name == name; });
}

Outcome impossible(const Technique& technique, std::string why) {
  Outcome outcome;
  outcome.decision.effect.technique = &technique;
  outcome.decision.effect.why = std::move(why);
  return outcome;
}

/// Whether a parameter that the effect needs is set.
bool has_needed_setting(const Technique& technique, const PlanRequest& asked) {
  const std::string& needs = technique.effect.needs;
  return needs.empty() || std::any_of(asked.settings.begin(), asked.settings.end(), [&](const auto& setting) {
           return setting.first == needs || setting.first == technique.name + "." + needs;
         });
}

/// Why an effect has no place in the picture of a frame; empty if it has one, or if the frame has no picture and the effect needs none.
std::string hindrance_in_picture(const Technique& technique, const std::vector<std::string>& available,
                                 const ComposeOptions& composing) {
  const Effect& effect = technique.effect;
  if (!contains(available, "color"))
    return effect.least_change > 0 ? "the frame has no 'color', which it would change" : "";
  std::vector<std::string> computed = {effect.changes};
  for (const ComposedPart& part : composition_of(available, computed, composing).parts)
    if (part.plane == effect.changes && !part.is_used) return part.how;
  return "";
}

bool is_setting_of(const std::string& name, const Technique& technique) {
  return std::any_of(technique.parameters.begin(), technique.parameters.end(),
                     [&](const Parameter& p) { return name == p.name || name == technique.name + "." + p.name; });
}

/// Throws UsageError for a setting of an effect that cannot be computed; names the one that needs the setting before others that take it.
void refuse_if_it_falls_away(const std::pair<std::string, std::string>& setting,
                             const std::vector<Outcome>& impossible_effects) {
  const Outcome* taker = nullptr;
  for (const Outcome& outcome : impossible_effects) {
    const Technique& technique = *outcome.decision.effect.technique;
    if (!is_setting_of(setting.first, technique)) continue;
    if (!taker || setting.first == technique.effect.needs) taker = &outcome;
  }
  if (!taker) return;
  throw UsageError("{}={}: is for {}, which falls away: {}", setting.first, setting.second,
                   taker->decision.effect.technique->effect.name, taker->decision.effect.why);
}

/// What an effect is planned for: the planes at hand, in words, and how a picture is composed of them.
struct Ground {
  std::vector<std::string> available;
  std::string holds;
  const ComposeOptions& composing;
};

/// The request for an effect if the frame has what it reads and a place for it; else why not, and in `missing` the planes that it lacks.
std::optional<PlanRequest> asked_if_possible(const Technique& technique, const PlanRequest& asked, const Ground& ground,
                                             std::string& why, std::optional<MissingPlanes>& missing) {
  why = hindrance_in_picture(technique, ground.available, ground.composing);
  if (!why.empty()) return {};
  try {
    return asked_of_effect(technique, asked, ground.available, ground.holds);
  } catch (const MissingPlanes& error) {
    if (!missing) missing = error;
    why = fmt::format("the frame has no '{}'", error.planes.front());
    return {};
  }
}

/// The unfit planes without any one of which an effect is not possible, though it would be with all.
std::vector<std::string> needed_of(const std::vector<Unfit>& unfit, const Technique& technique,
                                   const PlanRequest& asked, const Ground& all) {
  const auto is_possible = [&](const std::vector<Unfit>& without) {
    std::string why;
    std::optional<MissingPlanes> missing;
    const Ground ground{fit_planes(all.available, without), all.holds, all.composing};
    return asked_if_possible(technique, asked, ground, why, missing).has_value();
  };
  std::vector<std::string> needed;
  if (!is_possible({})) return needed;
  for (const Unfit& each : unfit)
    if (!is_possible({each})) needed.push_back(each.plane);
  return needed;
}

/// Throws an error with all reasons if no effect is possible, and for a setting that no effect has.
Candidates candidates_for(PlanRequest asked, const FrameFacts& facts, const ComposeOptions& composing,
                          const std::vector<Unfit>& unfit) {
  Candidates found;
  std::optional<MissingPlanes> missing;
  const bool of_display = facts.is_of_display;
  const Ground all{facts.planes, facts.holds, composing};
  const Ground fit{fit_planes(all.available, unfit), all.holds, composing};
  for (const Technique* technique : techniques_with_effects()) {
    if (technique->effect.for_displays && !of_display) continue;
    if (of_display && !technique->any_projection) {
      // Another technique of the same effect may support displays.
      if (!has_effect_for_displays(technique->effect.name))
        found.impossible.push_back(
            impossible(*technique, "its kernels need a single centre of projection, and a display has none"));
      continue;
    }
    if (!has_needed_setting(*technique, asked)) {
      const std::string& needs = technique->effect.needs;
      found.impossible.push_back(
          impossible(*technique, fmt::format("none is given ({})", option("set", needs + "=FILE"))));
      continue;
    }
    std::string why;
    const std::optional<PlanRequest> request = asked_if_possible(*technique, asked, fit, why, missing);
    if (!request) {
      const std::vector<std::string> needed = needed_of(unfit, *technique, asked, all);
      if (!needed.empty()) why = fmt::format("needs '{}', which is unfit", fmt::join(needed, "' and '"));
      found.impossible.push_back(impossible(*technique, why));
      continue;
    }
    found.possible.push_back({technique, *request});
    // One plane of a name: the first effect that has the extras makes them.
    if (!found.possible.back().asked.with.empty()) asked.with.clear();
  }
  if (found.possible.empty() && missing) throw *missing;
  // Colour holds all effects: nothing is to be computed.
  if (found.possible.empty()) return found;
  const bool has_filter = std::any_of(found.possible.begin(), found.possible.end(), [&](const Candidate& candidate) {
    return candidate.asked.filter == asked.filter;
  });
  if (!has_filter) found.possible.front().asked.filter = asked.filter;  // its plan reports the error
  for (const auto& setting : asked.settings) {
    const bool is_known = std::any_of(found.possible.begin(), found.possible.end(), [&](const Candidate& candidate) {
      const auto& settings = candidate.asked.settings;
      return std::find(settings.begin(), settings.end(), setting) != settings.end();
    });
    if (!is_known) refuse_if_it_falls_away(setting, found.impossible);
    if (!is_known) found.possible.front().asked.settings.push_back(setting);  // its plan reports the error
  }
  return found;
}

}  // namespace

void plan_effects(AutoPlan& planned, const PlanRequest& asked, const AutoPurpose& purpose) {
  const FrameFacts& facts = planned.facts;
  const std::vector<std::string> available = fit_planes(facts.planes, planned.unfit);
  planned.candidates = candidates_for(asked, facts, purpose.composing, planned.unfit);
  planned.plans.clear();
  planned.explains = purpose.explains;
  planned.planes = {"depth"};
  for (const Candidate& candidate : planned.candidates.possible) {
    planned.plans.push_back(plans_of_effect(*candidate.technique, candidate.asked, available, facts.holds));
    for (const Plan& plan : planned.plans.back()) add_new(planned.planes, plan.inputs);
  }
  if (purpose.explains || purpose.looks_at_picture || looks_at_changes(planned.candidates))
    for (const std::string& plane : planes_to_compose())
      if (contains(available, plane)) add_new(planned.planes, plane);
}

void check_goal(const Goal& goal, const AutoPlan& planned) {
  if (!goal) return;
  check_one_goal(goal);
  if (planned.facts.is_of_display)
    throw UsageError(
        "{}: weighs effects by the picture of one camera, and a light-field display has many; leave it out",
        in_words(goal));
  for (const Unfit& each : planned.unfit) {
    if (each.plane == "color")
      throw Error(
          "{}: needs the frame's colour to tell what effects change in it, and color is unfit: {}; {} has it taken",
          in_words(goal), each.why, channels_option("color", "CHANNELS"));
  }
  if (!contains(planned.facts.planes, "color"))
    throw UsageError(
        "{0}: needs the frame's colour to tell what effects change in it, and {1} has none; name it with {2}, or leave "
        "{0} out",
        in_words(goal), planned.facts.name, channels_option("color", "LAYER"));
}

}  // namespace gloam
