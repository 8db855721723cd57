#include "gloam/auto.h"

#include <algorithm>
#include <cmath>

#include "auto/automatic.h"
#include "auto/candidates.h"
#include "auto/picture_parts.h"
#include "auto/weighing.h"
#include "base/lists.h"
#include "gloam/compute.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"

namespace gloam {
namespace {

double best(const RunResult& result) {
  return result.total_ms.empty() ? 0 : *std::min_element(result.total_ms.begin(), result.total_ms.end());
}

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Adds the planes of effects that the frame does not call for: nothing is occluded, nothing is reflected.
void add_idle_planes(const Frame& frame, const std::vector<std::string>& outputs, Frame& out) {
  const Layout layout(frame.width(), frame.height());
  for (View& view : out.views)
    for (const std::string& name : outputs) view.planes[name] = empty_plane(name, layout);
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

std::vector<std::string> planes_of_every_view(const Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> found;
  for (const std::string& plane : planes) {
    const auto has = [&](const View& view) { return view.find(plane) != nullptr; };
    if (std::all_of(frame.views.begin(), frame.views.end(), has)) found.push_back(plane);
  }
  return found;
}

}  // namespace

bool looks_at_changes(const Candidates& candidates) {
  return std::any_of(candidates.possible.begin(), candidates.possible.end(),
                     [](const Candidate& candidate) { return candidate.technique->effect.least_change > 0; });
}

FrameFacts facts_of(const Frame& frame, const std::string& name) {
  FrameFacts facts{.name = name, .planes = common_planes(frame), .width = frame.width(), .height = frame.height()};
  facts.holds = planes_in_words(facts.planes);
  facts.views = frame.views.size();
  facts.is_of_display = std::any_of(frame.views.begin(), frame.views.end(),
                                    [](const View& view) { return view.camera && view.camera->slits; });
  return facts;
}

AutoPlan plan_auto(FrameFacts facts, const PlanRequest& asked, const AutoPurpose& purpose,
                   const std::vector<Unfit>& unfit) {
  AutoPlan planned{.facts = std::move(facts), .unfit = unfit};
  plan_effects(planned, asked, purpose);
  return planned;
}

void judge(AutoPlan& planned, const std::vector<std::string>& assumed, const PlanRequest& asked,
           const AutoPurpose& purpose) {
  planned.unfit = unfit_planes(assumed);
  if (!planned.unfit.empty()) plan_effects(planned, asked, purpose);
}

void set_radius(AutoPlan& planned, std::optional<double> radius) {
  for (Candidate& candidate : planned.candidates.possible) candidate.asked.radius = radius;
}

namespace {

/// Of copies of the frame's planes that composing reads, and of those that effects add.
unsigned long long bytes_to_compose(const AutoPlan& planned) {
  size_t components = 0;
  for (const std::vector<std::string>& planes : {planes_to_compose(), part_planes()})
    for (const std::string& plane : planes) components += plane_kind(plane).components.size();
  return components * Layout(planned.facts.width, planned.facts.height).bytes() * planned.facts.views;
}

}  // namespace

// Results of each effect stay in memory, and its masked results while it runs without the mask.
unsigned long long bytes_beside_frame(const AutoPlan& planned, bool shares_memory) {
  const Layout layout(planned.facts.width, planned.facts.height);
  unsigned long long most = 0;
  for (const std::vector<Plan>& plans : planned.plans) {
    for (const Plan& plan : plans)
      most = std::max(most, bytes_beside_frame(plan, layout, planned.facts.views, false) +
                                bytes_beside_frame(plan, layout, planned.facts.views, shares_memory));
  }
  // Once all has run, the picture of all is composed, and for each effect the picture without it: of copies of what composing reads.
  if (planned.explains && contains(planned.facts.planes, "color")) most = std::max(most, 2 * bytes_to_compose(planned));
  return bytes_of_results(planned) + most;
}

unsigned long long bytes_of_results(const AutoPlan& planned) {
  const Layout layout(planned.facts.width, planned.facts.height);
  unsigned long long bytes = 0;
  for (const std::vector<Plan>& plans : planned.plans) {
    unsigned long long most = 0;
    for (const Plan& plan : plans) most = std::max(most, bytes_beside_frame(plan, layout, planned.facts.views, false));
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
    if (outcome.is_left_out) why = "the choice for the goal does without";
    fixed[effect.technique->name] = {outcome.runs(), outcome.decision.request, why + ", on the first frame",
                                     outcome.setting};
  }
  return fixed;
}

AutoResult compute_effects(AutoPlan& planned, const AutoSettings& settings, const Frame& frame, Device& device,
                           const RunOptions& options) {
  const std::vector<std::string> available = planes_of_every_view(frame, planned.planes);
  const std::string& holds = planned.facts.holds;
  AutoResult result{.frame = without_planes(frame)};
  ProbedMasks masks;
  const auto probe_for = [&](const Candidate& candidate) {
    return EffectProbe{candidate.asked, frame, available, holds, device, options, {}, {}, &masks};
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
    if (!std::isnan(change) && settings.mask != MaskUse::always)
      probe.seen_share = glance->share_of(candidate.technique->effect.changes);
    Outcome outcome = decided(*candidate.technique, settings, probe);
    outcome.change = change;
    if (!settings.goal || !outcome.decision.effect.is_wanted) compute_decided(outcome, settings, probe, result.frame);
    result.outcomes.push_back(std::move(outcome));
  }
  if (glance) result.glance_ms = glance->ms();
  if (settings.goal && glance) spend_budget(planned.candidates, settings, *glance, probe_for, result);
  if (settings.goal && !glance) result.spent.emplace();
  if (glance && (settings.goal || settings.purpose.explains)) {
    result.expected = expected_of(result.outcomes, *glance);
    result.picture_rms = glance->rms();
  }
  if (glance && settings.purpose.explains)
    result.picture = show_changes(frame, *glance, settings.purpose.composing, result);
  for (const Outcome& outcome : result.outcomes) {
    if (result.used_radius || !outcome.plan) continue;
    result.used_radius = radius_of(*outcome.plan, outcome.decision.request, settings.radius_from);
    if (!result.used_radius) continue;
    result.radius_cap = cap_of(*outcome.plan);
    const std::string warning = warning_about(*result.used_radius, frame, result.radius_cap);
    if (!warning.empty()) result.notes.push_back(warning);
  }
  for (Outcome& outcome : planned.candidates.impossible) result.outcomes.push_back(std::move(outcome));
  std::vector<MadeBy> made_by;
  for (const Outcome& outcome : result.outcomes)
    if (outcome.plan) made_by.push_back({&*outcome.plan, outcome.runs()});
  result.frame.attributes = provenance(made_by, options);
  return result;
}

AutoResult compute_auto(const Frame& frame, const PlanRequest& asked, AutoSettings settings, Device& device,
                        const RunOptions& options) {
  check(frame);
  settings.purpose.looks_at_picture |= bool(settings.goal);
  AutoPlan planned = plan_auto(facts_of(frame), asked, settings.purpose);
  judge(planned, frame.assumed, asked, settings.purpose);
  check_goal(settings.goal, planned);
  const Radius made = default_radius(frame, stated_radius(frame));
  set_radius(planned, asked.radius.value_or(made.value));
  settings.radius_from = asked.radius ? RadiusSource::flag : made.from;
  const std::vector<std::string> usable = fit_planes(common_planes(frame), planned.unfit);
  AutoResult result;
  if (planned.unfit.empty()) {
    result = compute_effects(planned, settings, frame, device, options);
  } else {
    Frame fit = without_planes(frame);
    for (const View& view : frame.views)
      for (const auto& [name, plane] : view.planes)
        if (name == "color" || contains(usable, name)) fit.view(view.name).planes[name] = plane.clone();
    result = compute_effects(planned, settings, fit, device, options);
  }
  if (std::string missed = note_on_goal(result, settings.goal); !missed.empty()) result.notes.push_back(missed);
  return result;
}

}  // namespace gloam
