#include "cli/auto/frame.h"

#include <algorithm>
#include <cmath>

#include "cli/auto/budget.h"
#include "cli/flags/memory.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"

namespace gloam::cli {
namespace {

double best(const RunResult& result) {
  return result.total_ms.empty() ? 0 : *std::min_element(result.total_ms.begin(), result.total_ms.end());
}

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Adds the planes of effects that the frame does not call for: nothing is occluded, nothing is reflected.
void add_idle_planes(const Frame& frame, const std::vector<std::string>& outputs, Frame& out) {
  const Layout layout(frame.width(), frame.height());
  for (View& view : out.views) {
    for (const std::string& name : outputs) {
      const PlaneKind kind = plane_kind(name);
      Plane plane{name, {}};
      for (size_t i = 0; i < kind.components.size(); ++i) {
        Channel& channel = plane.channels.emplace_back(layout);
        for (int y = 0; y < layout.height; ++y) std::fill_n(channel.row(y), layout.width, kind.outside);
        channel.fill_padding(kind.outside);
      }
      view.planes[name] = std::move(plane);
    }
  }
}

/// Also finds the classes of the cells, for a picture of them.
void probe_closely_for_picture(EffectChoice& choice, const EffectProbe& probe) {
  if (choice.is_wanted && !choice.is_everywhere) probe_closely(choice, probe);
}

/// Whether an effect is wanted, and how.
Outcome decided(const Technique& technique, const AutoSettings& settings, const EffectProbe& probe) {
  Outcome outcome{.decision = decide(technique, probe)};
  EffectChoice& effect = outcome.decision.effect;
  if (settings.purpose.explains) {
    probe_closely_for_picture(effect, probe);
    for (EffectChoice& refinement : outcome.decision.refinements) probe_closely_for_picture(refinement, probe);
  }
  outcome.ms = effect.classify_ms;
  return outcome;
}

void compute_decided(Outcome& outcome, const AutoSettings& settings, const EffectProbe& probe, Frame& out) {
  const EffectChoice& effect = outcome.decision.effect;
  if (effect.is_wanted) {
    Computed computed = compute(outcome.decision, probe, settings.mask);
    outcome.ms += computed.ms;
    outcome.is_masked = computed.is_masked;
    outcome.ms_masked = computed.ms_masked;
    outcome.ms_everywhere = computed.ms_everywhere;
    take_planes(computed.result.frame, out);
  }
  outcome.plan = make_plan(outcome.decision.request, probe.available, probe.holds);
  outcome.outputs = outcome.plan->outputs;
  if (!effect.is_wanted && !effect.is_too_faint) add_idle_planes(probe.frame, outcome.outputs, out);
  if (settings.measures && std::isnan(outcome.ms_everywhere)) {
    const Plan everywhere = make_plan(outcome.decision.everywhere, probe.available, probe.holds);
    outcome.ms_everywhere = best(run(everywhere, probe.frame, probe.device, probe.options));
  }
}

Outcome computed_as_fixed(const Candidate& candidate, const FixedEffect& fixed, const EffectProbe& probe, Frame& out) {
  Outcome outcome;
  EffectChoice& effect = outcome.decision.effect;
  effect.technique = candidate.technique;
  effect.is_wanted = fixed.runs;
  effect.is_everywhere = fixed.runs;
  effect.why = fixed.why;
  outcome.setting = fixed.setting;
  outcome.decision.request = fixed.request;
  if (!fixed.runs) return outcome;
  outcome.plan = make_plan(fixed.request, probe.available, probe.holds);
  outcome.outputs = outcome.plan->outputs;
  RunResult result = run(*outcome.plan, probe.frame, probe.device, probe.options);
  outcome.ms = best(result);
  take_planes(result.frame, out);
  return outcome;
}

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
Candidates candidates_for(PlanRequest asked, const FrameFiles& files, const ComposeOptions& composing,
                          const std::vector<Unfit>& unfit) {
  Candidates found;
  std::optional<MissingPlanes> missing;
  const bool of_display = is_of_display(files);
  const Ground all{files.common_planes(), holdings(files), composing};
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
      found.impossible.push_back(impossible(*technique, fmt::format("none is given (--set {}=FILE)", needs)));
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
  const bool has_filter = std::any_of(found.possible.begin(), found.possible.end(),
                                      [&](const Candidate& candidate) { return candidate.asked.then == asked.then; });
  if (!has_filter) found.possible.front().asked.then = asked.then;  // its plan reports the error
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

/// What may run on the frame without its unfit planes, and what to decode for it.
void plan_effects(AutoFrame& planned, const PlanRequest& asked, const AutoPurpose& purpose) {
  const FrameFiles& files = planned.files;
  const std::vector<std::string> available = fit_planes(files.common_planes(), planned.unfit);
  planned.candidates = candidates_for(asked, files, purpose.composing, planned.unfit);
  planned.plans.clear();
  planned.planes = {"depth"};
  for (const Candidate& candidate : planned.candidates.possible) {
    planned.plans.push_back(plans_of_effect(*candidate.technique, candidate.asked, available, holdings(files)));
    for (const Plan& plan : planned.plans.back()) add_new(planned.planes, plan.inputs);
  }
  if (purpose.explains || purpose.looks_at_picture || looks_at_changes(planned.candidates))
    for (const std::string& plane : planes_to_compose())
      if (contains(available, plane)) add_new(planned.planes, plane);
}

std::vector<std::string> planes_of_every_view(const Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> found;
  for (const std::string& plane : planes) {
    const auto has = [&](const View& view) { return view.find(plane) != nullptr; };
    if (std::all_of(frame.views.begin(), frame.views.end(), has)) found.push_back(plane);
  }
  return found;
}

}  // namespace

void take_planes(Frame& from, Frame& to) {
  for (View& view : from.views) {
    for (auto& [name, plane] : view.planes) to.view(view.name).planes[name] = std::move(plane);
  }
}

bool looks_at_changes(const Candidates& candidates) {
  return std::any_of(candidates.possible.begin(), candidates.possible.end(),
                     [](const Candidate& candidate) { return candidate.technique->effect.least_change > 0; });
}

bool is_of_display(const FrameFiles& files) {
  for (const FrameFile& file : files.files()) {
    for (const std::string& view : file.views()) {
      const std::optional<Camera> camera = file.camera(view);
      if (camera && camera->slits) return true;
    }
  }
  return false;
}

AutoFrame planned_auto(FrameFiles files, const PlanRequest& asked, const AutoPurpose& purpose,
                       const std::vector<Unfit>& unfit) {
  AutoFrame planned{std::move(files), {}, {}, {}, unfit};
  plan_effects(planned, asked, purpose);
  return planned;
}

void check_has_depth(const AutoFrame& planned, const std::string& out) {
  if (out.empty() || contains(planned.files.common_planes(), "depth")) return;
  throw Error(
      "{}: has no depth, so that no effect can be computed and -o {} would be empty; give a frame with depth, or "
      "--composite alone",
      planned.files.name(), out);
}

Frame read_and_judge(AutoFrame& planned, const PlanRequest& asked, const AutoPurpose& purpose) {
  Frame frame = planned.files.read(planned.planes);
  planned.unfit = unfit_planes(frame.assumed);
  if (planned.unfit.empty()) return frame;
  plan_effects(planned, asked, purpose);
  for (View& view : frame.views) {
    for (const Unfit& each : planned.unfit)
      if (each.plane != "color") view.planes.erase(each.plane);
  }
  return frame;
}

void set_radius(AutoFrame& planned, std::optional<double> radius) {
  for (Candidate& candidate : planned.candidates.possible) candidate.asked.radius = radius;
}

// Results of each effect stay in memory, and its masked results while it runs without the mask.
unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory) {
  const Layout layout(planned.files.window().width(), planned.files.window().height());
  const size_t views = planned.files.views().size();
  unsigned long long kept = 0, most = 0;
  for (const std::vector<Plan>& plans : planned.plans) {
    unsigned long long results = 0;
    for (const Plan& plan : plans) {
      const unsigned long long own = bytes_beside_frame(plan, layout, views, false);
      results = std::max(results, own);
      most = std::max(most, own + bytes_beside_frame(plan, layout, views, shares_memory));
    }
    kept += results;
  }
  return process_bytes_with_device + bytes_to_read(planned.files, planned.planes) + kept + most;
}

unsigned long long bytes_of_results(const AutoFrame& planned) {
  const Layout layout(planned.files.window().width(), planned.files.window().height());
  unsigned long long bytes = 0;
  for (const std::vector<Plan>& plans : planned.plans) {
    unsigned long long most = 0;
    for (const Plan& plan : plans)
      most = std::max(most, bytes_beside_frame(plan, layout, planned.files.views().size(), false));
    bytes += most;
  }
  return bytes;
}

FixedEffects fixed_by(const AutoResult& first) {
  FixedEffects fixed;
  for (const Outcome& outcome : first.outcomes) {
    const EffectChoice& effect = outcome.decision.effect;
    const bool is_possible = outcome.plan || outcome.is_left_out;
    if (!is_possible || (!first.spent && !effect.is_too_faint)) continue;
    std::string why = effect.why;
    if (outcome.is_left_out) why = "the budget does without";
    fixed[effect.technique->name] = {outcome.runs(), outcome.decision.request, why + ", on the first frame",
                                     outcome.setting};
  }
  return fixed;
}

AutoResult compute_effects(AutoFrame& planned, const AutoSettings& settings, const Frame& frame, Device& device,
                           const RunOptions& options) {
  const std::vector<std::string> available = planes_of_every_view(frame, planned.planes);
  const std::string holds = holdings(planned.files);
  AutoResult result{without_planes(frame), {}, {}, {}};
  ProbedMasks masks;
  const auto probe_for = [&](const Candidate& candidate) {
    return EffectProbe{candidate.asked, frame, available, holds, device, options, {}, &masks};
  };
  std::optional<Glance> glance;
  if (!settings.fixed && !planned.candidates.possible.empty() && contains(available, "color") &&
      (settings.purpose.explains || settings.goal || looks_at_changes(planned.candidates)))
    glance = glance_at(planned.candidates, settings.purpose.explains || settings.goal, settings.purpose.composing,
                       probe_for);
  for (const Candidate& candidate : planned.candidates.possible) {
    EffectProbe probe = probe_for(candidate);
    if (settings.fixed && settings.fixed->count(candidate.technique->name)) {
      const FixedEffect& fixed = settings.fixed->at(candidate.technique->name);
      result.outcomes.push_back(computed_as_fixed(candidate, fixed, probe, result.frame));
      continue;
    }
    const double change = glance ? change_by(*candidate.technique, *glance) : not_known;
    if (!std::isnan(change)) probe.change = change / std::max(glance->rms(), 1e-30);
    Outcome outcome = decided(*candidate.technique, settings, probe);
    outcome.change = change;
    if (settings.purpose.explains && glance) add_changes(outcome, *glance);
    if (!settings.goal || !outcome.decision.effect.is_wanted) compute_decided(outcome, settings, probe, result.frame);
    result.outcomes.push_back(std::move(outcome));
  }
  if (glance) result.glance_ms = glance->ms();
  if (settings.goal && glance) spend_budget(planned.candidates, settings, *glance, probe_for, result);
  if (settings.goal && !glance) result.spent.emplace();
  for (const Outcome& outcome : result.outcomes) {
    if (result.radius || !outcome.plan) continue;
    result.used_radius = radius_of(*outcome.plan, outcome.decision.request, settings.radius_from);
    if (result.used_radius) result.radius.emplace(*result.used_radius, frame, cap_of(*outcome.plan));
  }
  for (Outcome& outcome : planned.candidates.impossible) result.outcomes.push_back(std::move(outcome));
  std::vector<MadeBy> made_by;
  for (const Outcome& outcome : result.outcomes)
    if (outcome.plan) made_by.push_back({&*outcome.plan, outcome.runs()});
  result.frame.attributes = provenance(made_by, options);
  return result;
}

}  // namespace gloam::cli
