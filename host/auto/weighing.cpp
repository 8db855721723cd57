#include "auto/weighing.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/lists.h"
#include "base/statistics.h"
#include "planner/speeds.h"

namespace gloam {
namespace {

constexpr double unlooked_at = std::numeric_limits<double>::quiet_NaN();

/// The preset of an effect in the look.
std::string preset_of_glance(const Technique& technique, const PlanRequest& asked) {
  return asked.preset.empty() && !technique.presets.empty() ? technique.presets.front().name : asked.preset;
}

/// The effect at its cheapest, with all that completes it.
PlanRequest request_of_glance(const Technique& technique, const EffectProbe& probe) {
  PlanRequest request = request_everywhere(technique, probe.asked);
  request.resolution = 1;
  request.with.clear();
  request.adaptive.clear();
  request.preset = preset_of_glance(technique, probe.asked);
  for (const Technique* more : techniques_that_complete(technique)) {
    const std::vector<std::string>& reads = more->reads;
    const bool has_all = std::all_of(reads.begin(), reads.end(), [&](const std::string& plane) {
      return contains(probe.available, plane) || contains(outputs_of(technique), plane);
    });
    if (has_all) request.outputs.push_back(more->name);
  }
  return with_known_settings(technique, request, probe.available, probe.holds);
}

/// One request for what two ask for; none if they differ in more than techniques and these' own settings.
std::optional<PlanRequest> joined(const std::optional<PlanRequest>& a, const PlanRequest& b) {
  if (!a || a->preset != b.preset || a->filter != b.filter || a->radius != b.radius) return {};
  PlanRequest both = *a;
  add_new(both.outputs, b.outputs);
  for (const auto& setting : b.settings)
    if (std::find(both.settings.begin(), both.settings.end(), setting) == both.settings.end())
      both.settings.push_back(setting);
  return both;
}

/// Plans for the looks at these effects: one for all where their passes go together, so that they share what each needs (normals, the
/// frame's planes on the device).
std::vector<Plan> plans_of_glance(const std::vector<const Candidate*>& candidates, const ProbeFor& probe_for) {
  std::vector<PlanRequest> requests;
  for (const Candidate* candidate : candidates)
    requests.push_back(request_of_glance(*candidate->technique, probe_for(*candidate)));
  const EffectProbe first = probe_for(*candidates.front());
  std::optional<PlanRequest> all = requests.front();
  for (size_t i = 1; i < requests.size(); ++i) all = joined(all, requests[i]);
  std::vector<Plan> plans;
  if (all && requests.size() > 1) {
    try {
      plans.push_back(make_plan(*all, first.available, first.holds));
      return plans;
    } catch (const UsageError&) {
      // Settings or planes of one are another's too: each gets a plan of its own.
    }
  }
  for (const PlanRequest& request : requests) plans.push_back(make_plan(request, first.available, first.holds));
  return plans;
}

BudgetedEffect budgeted(const Candidate& candidate, const Outcome& outcome, const AutoSettings& settings,
                        const Glance& glance, const EffectProbe& probe) {
  BudgetedEffect effect;
  effect.technique = candidate.technique;
  const PlanRequest& request = outcome.decision.request;
  if (settings.mask != MaskUse::never) {
    effect.mask = request.only;
    effect.elsewhere = request.elsewhere;
  }
  const SeenEffect seen{candidate.technique, preset_of_glance(*candidate.technique, probe.asked),
                        common_planes(glance.parts()), scale_of_glance(probe.frame)};
  const bool is_taken = !settings.for_other_frames && settings.mask != MaskUse::always;
  effect.options = options_of(find_technique(request.outputs.front()), probe, is_taken ? seen : SeenEffect{});
  return effect;
}

void take_budgeted(BudgetedEffect& effect, Outcome& outcome, Frame& out) {
  outcome.change = effect.change;
  outcome.lost = effect.lost;
  if (effect.chosen == left_out) {
    outcome.is_left_out = true;
    return;
  }
  const EffectOption& option = effect.options[size_t(effect.chosen)];
  outcome.setting = option.setting();
  outcome.decision.request = option.request;
  outcome.decision.effect.is_everywhere = !effect.is_masked;
  outcome.is_masked = effect.is_masked;
  outcome.ms += effect.ms;
  outcome.plan = std::move(effect.plan);
  outcome.outputs = outcome.plan->outputs;
  take_planes(effect.result.frame, out);
}

double ms_everywhere(const Decision& decision, const EffectProbe& probe) {
  const Plan plan = make_plan(decision.everywhere, probe.available, probe.holds);
  return median(run(plan, probe.frame, probe.device, probe.options).total_ms);
}

}  // namespace

std::vector<std::string> planes_of(const Technique& technique) {
  std::vector<std::string> planes = {technique.effect.changes};
  for (const Technique* more : techniques_that_complete(technique)) planes.push_back(more->effect.changes);
  return planes;
}

Glance glance_at(const Candidates& candidates, bool at_all, const ComposeOptions& composing,
                 const ProbeFor& probe_for) {
  const EffectProbe first = probe_for(candidates.possible.front());
  Glance glance(first.frame, composing);
  std::vector<const Candidate*> looked_at;
  for (const Candidate& candidate : candidates.possible)
    if (at_all || candidate.technique->effect.least_change > 0) looked_at.push_back(&candidate);
  glance.look(plans_of_glance(looked_at, probe_for), first.device, first.options);
  return glance;
}

double change_by(const Technique& technique, const Glance& glance) {
  return contains(glance.planes(), technique.effect.changes) ? glance.change_by(planes_of(technique)) : unlooked_at;
}

ExpectedError expected_of(const std::vector<Outcome>& outcomes, const Glance& glance) {
  std::vector<UsedPlane> planes;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.runs()) continue;
    const PlanRequest& request = outcome.decision.request;
    for (const std::string& plane : part_planes())
      if (contains(outcome.outputs, plane))
        planes.push_back(plane_by(plane, request.preset, request.resolution, glance.seen()));
  }
  const ExpectedSquare expected = expected_square(glance.model(), used_among(planes, glance.uses()));
  return {expected.error(), expected.uncertainty(), expected_square(glance.model(), {}).error()};
}

void spend_budget(const Candidates& candidates, const AutoSettings& settings, const Glance& glance,
                  const ProbeFor& probe_for, AutoResult& result) {
  std::vector<BudgetedEffect> effects;
  std::vector<Outcome*> owners;
  double probing_ms = 0;
  for (size_t i = 0; i < candidates.possible.size(); ++i) {
    Outcome& outcome = result.outcomes[i];
    probing_ms += outcome.decision.effect.classify_ms;
    if (!outcome.decision.effect.is_wanted) continue;
    effects.push_back(budgeted(candidates.possible[i], outcome, settings, glance, probe_for(candidates.possible[i])));
    owners.push_back(&outcome);
  }
  const EffectProbe probe = probe_for(candidates.possible.front());
  OptionSpeeds speeds(probe.device.info());
  const BudgetMeans means{.frame = probe.frame,
                          .available = probe.available,
                          .holds = probe.holds,
                          .device = probe.device,
                          .options = probe.options,
                          .glance = glance,
                          .looking_ms = settings.for_other_frames ? 0 : glance.ms() + probing_ms,
                          .always_masked = settings.mask == MaskUse::always,
                          .measuring = settings.measuring};
  result.spent = spend(effects, settings.goal, means, speeds);
  for (size_t i = 0; i < effects.size(); ++i) {
    if (settings.measures) owners[i]->ms_everywhere = ms_everywhere(owners[i]->decision, probe);
    take_budgeted(effects[i], *owners[i], result.frame);
  }
}

}  // namespace gloam
