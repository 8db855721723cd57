#include "auto/automatic.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/lists.h"
#include "gloam/composition.h"
#include "plan/adaptive.h"

namespace gloam {
namespace {

std::vector<const Technique*> refinements_of(const Technique& technique) {
  std::vector<const Technique*> found;
  for (const Technique& t : registry()) {
    if (t.effect.refines == technique.name) found.push_back(&t);
  }
  return found;
}

bool is_of(const std::string& setting, const std::string& technique) { return setting.rfind(technique + ".", 0) == 0; }

/// The settings of the request that apply to a technique. A technique that refines another also gets that one's: "gtao.bias" as
/// "stereo-gtao.bias". Settings for other techniques, which may or may not run, are left out.
Settings settings_for(const Technique& technique, const PlanRequest& asked) {
  Settings settings = technique.effect.settings;
  const std::string& refined = technique.effect.refines;
  const std::vector<const Technique*> others = refinements_of(refined.empty() ? technique : find_technique(refined));
  for (const auto& [name, value] : asked.settings) {
    const bool is_of_another = std::any_of(others.begin(), others.end(), [&, &name = name](const Technique* other) {
      return other != &technique && is_of(name, other->name);
    });
    if (is_of_another) continue;
    const bool is_of_refined = !refined.empty() && is_of(name, refined);
    settings.emplace_back(is_of_refined ? technique.name + name.substr(refined.size()) : name, value);
  }
  return settings;
}

/// Checks the settings of techniques that may not run, too.
void check_settings(const std::vector<const Technique*>& refinements, const PlanRequest& asked) {
  for (const auto& [name, value] : asked.settings) {
    for (const Technique* technique : refinements) {
      if (!is_of(name, technique->name)) continue;
      const std::string bare = name.substr(technique->name.size() + 1);
      ParameterValues values(technique->parameters);
      std::vector<std::string> known;
      for (const Parameter& p : technique->parameters) known.push_back(p.name);
      if (!values.has(bare))
        throw UsageError("{}: no parameter '{}'{}; there are {}", technique->name, bare, suggestion(bare, known),
                         enumerate(known));
      values.set(bare, value, technique->name);
    }
  }
}

/// Whether a filter makes a plane that the technique leaves to a filter. Unknown names pass: the plan refuses them.
bool filters(const std::string& filter, const Technique& technique) {
  if (filter.empty() || filter == "none" || !contains(technique_names(), filter)) return true;
  const std::vector<std::string>& made = find_technique(filter).writes;
  return std::any_of(made.begin(), made.end(),
                     [&](const std::string& plane) { return contains(outputs_of(technique), plane); });
}

/// Whether some tiles can get fewer samples (`PlanRequest::adaptive`).
bool can_adapt(const Technique& technique) {
  const std::vector<Pass> passes = technique.passes(ParameterValues(technique.parameters));
  return std::any_of(passes.begin(), passes.end(), is_estimate);
}

/// Whether the plan of an effect has a parameter of this name: "radius", or "gtao.radius".
bool knows(const Plan& plan, const Technique& technique, const std::string& setting) {
  const std::vector<const Technique*> refinements = refinements_of(technique);
  if (std::any_of(refinements.begin(), refinements.end(), [&](const Technique* t) { return is_of(setting, t->name); }))
    return true;
  return std::any_of(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& planned) {
    const bool is_its_own = is_of(setting, planned.technique->name);
    return planned.values.has(is_its_own ? setting.substr(planned.technique->name.size() + 1) : setting);
  });
}

const ParameterValues& values_of(const Plan& plan, const Technique& technique) {
  return std::find_if(plan.passes.begin(), plan.passes.end(),
                      [&](const PlannedPass& planned) { return planned.technique == &technique; })
      ->values;
}

/// A request for the mask alone, with the technique's parameters of the same names, overridden by `more`.
PlanRequest mask_request(const Technique& technique, const EffectProbe& probe, const Settings& more, int resolution) {
  const std::string& mask = technique.effect.mask;
  PlanRequest request{.outputs = {mask}, .as_cells = true, .resolution = resolution};
  if (technique.views == 1) {
    PlanRequest restricted = request_everywhere(technique, probe.asked);
    restricted.only = mask;
    const Plan whole = make_plan(restricted, probe.available, probe.holds);
    const ParameterValues& values = values_of(whole, find_technique(mask));
    for (const Parameter& p : values.table()) request.settings.emplace_back(mask + "." + p.name, values.text(p.name));
  }
  for (const auto& [name, value] : more) request.settings.emplace_back(mask + "." + name, value);
  return request;
}

double share_above_0(const Frame& frame, const std::string& plane) {
  double above = 0, all = 0;
  for (const View& view : frame.views) {
    const Channel& channel = view.find(plane)->channels.front();
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y) {
      const float* row = channel.row(y);
      above += double(std::count_if(row, row + layout.width, [](float value) { return value > 0; }));
    }
    all += double(layout.width) * layout.height;
  }
  return all > 0 ? above / all : 0;
}

std::string in_percent(double share) { return share < 0.01 ? "less than 1 %" : fmt::format("{:.0f} %", 100 * share); }

std::string text_of(const PlanRequest& mask) {
  std::string text = fmt::format("{} {}", mask.outputs.front(), mask.resolution);
  for (const auto& [name, value] : mask.settings) text += fmt::format(" {}={}", name, value);
  return text;
}

void take_mask(EffectChoice& choice, const ProbedMask& mask) {
  choice.cells = mask.cells;
  choice.share = mask.share;
  choice.seen = mask.seen;
}

void probe_mask(EffectChoice& choice, const EffectProbe& probe, const Settings& settings, int resolution) {
  const PlanRequest request = mask_request(*choice.technique, probe, settings, resolution);
  const std::string text = text_of(request);
  if (probe.masks && probe.masks->count(text)) return take_mask(choice, probe.masks->at(text));
  const Plan plan = make_plan(request, probe.available, probe.holds);
  RunResult result = run(plan, probe.frame, probe.device, probe.options);
  const std::string& cells = plan.outputs.front();
  const ProbedMask mask{cells, share_above_0(result.frame, cells), std::make_shared<Frame>(std::move(result.frame))};
  take_mask(choice, mask);
  choice.classify_ms += *std::min_element(result.total_ms.begin(), result.total_ms.end());
  if (probe.masks) probe.masks->emplace(text, mask);
}

EffectChoice choose(const Technique& technique, const EffectProbe& probe) {
  EffectChoice choice{.technique = &technique};
  const Effect& effect = technique.effect;
  if (effect.mask.empty()) {
    choice.share = 1;
    choice.is_everywhere = true;
  } else if (probe.seen_share && *probe.seen_share > effect.most_share) {
    // The look tells that a mask cannot pay, so none is probed.
    choice.share = *probe.seen_share;
    choice.is_everywhere = true;
  } else {
    probe_mask(choice, probe, effect.probe, effect.probe_resolution);
    choice.is_everywhere = choice.share > effect.most_share;
    // The mask may find what a probe overlooks.
    if (choice.share == 0 && effect.least_share == 0) probe_mask(choice, probe, {}, 1);
  }
  choice.is_wanted = choice.share > effect.least_share;
  if (choice.is_wanted && probe.change && *probe.change < effect.least_change) {
    choice.is_wanted = false;
    choice.is_too_faint = true;
    choice.why =
        fmt::format("{}, but that changes the picture by {} only", effect.somewhere, in_percent(*probe.change));
    return choice;
  }
  choice.why =
      choice.is_wanted
          ? fmt::format("{} on {} of the image{}", effect.somewhere, in_percent(choice.share),
                        choice.is_everywhere && !effect.mask.empty() ? ", so a mask would cost more than it saves" : "")
          : effect.nowhere;
  return choice;
}

/// The reason why a frame or request does not suit a technique that refines an effect; empty if it does.
std::string hindrance(const Technique& technique, const EffectProbe& probe) {
  if (technique.views == 2 && probe.frame.views.size() != 2)
    return fmt::format("the frame has {}", probe.frame.views.size() == 1 ? "one view" : "more than two views");
  const auto has_pose = [](const View& view) { return view.camera && view.camera->pose; };
  if (technique.views == 2 && !std::all_of(probe.frame.views.begin(), probe.frame.views.end(), has_pose))
    return "the positions of the two cameras are unknown";
  try {
    make_plan(request_everywhere(technique, probe.asked), probe.available, probe.holds);
  } catch (const MissingPlanes& missing) {
    const std::string& plane = missing.planes.front();
    const auto least = missing.instead.find(plane);
    return fmt::format("the frame has no '{}'", least == missing.instead.end() ? plane : least->second);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

/// `chosen`: the refinement already chosen, or null.
EffectChoice choose_refinement(const Technique& technique, const Technique* chosen, const EffectProbe& probe) {
  std::string why_not = hindrance(technique, probe);
  if (why_not.empty() && chosen) why_not = fmt::format("{} already runs in its place", chosen->name);
  if (why_not.empty()) return choose(technique, probe);
  EffectChoice choice{.technique = &technique};
  choice.why = std::move(why_not);
  return choice;
}

/// Replaces the technique that it refines, or runs beside it if a mask separates the two.
PlanRequest refined_request(const EffectChoice& refinement, const Technique& refined, const EffectProbe& probe) {
  const Technique& technique = *refinement.technique;
  PlanRequest request = request_everywhere(technique, probe.asked);
  if (technique.views == 2 || refinement.is_everywhere || probe.asked.resolution > 1) return request;
  request.only = technique.effect.mask;
  request.elsewhere = refined.name;
  for (const auto& setting : probe.asked.settings) {
    if (is_of(setting.first, refined.name)) request.settings.push_back(setting);
  }
  return request;
}

/// Least number of rounds to decide whether a mask pays.
constexpr int least_rounds = 3;

double least(const std::vector<double>& ms) { return ms.empty() ? 0 : *std::min_element(ms.begin(), ms.end()); }

void leave_mask_out(Decision& decision, const std::string& why) {
  decision.request = decision.everywhere;
  decision.effect.is_everywhere = true;
  decision.effect.why += why;
}

}  // namespace

PlanRequest request_everywhere(const Technique& technique, const PlanRequest& asked) {
  PlanRequest request = asked;
  request.outputs = {technique.name};
  request.settings = settings_for(technique, asked);
  return request;
}

PlanRequest asked_of_effect(const Technique& technique, const PlanRequest& asked,
                            const std::vector<std::string>& available, const std::string& holds) {
  PlanRequest known = asked;
  if (technique.then.empty() || !filters(known.filter, technique)) known.filter.clear();
  if (technique.extras.empty()) known.with.clear();
  if (!can_adapt(technique)) known.adaptive.clear();
  PlanRequest request = known;
  request.outputs = {technique.name};
  request.only = technique.effect.mask;
  known.settings = with_known_settings(technique, request, available, holds).settings;
  return known;
}

PlanRequest with_known_settings(const Technique& technique, PlanRequest request,
                                const std::vector<std::string>& available, const std::string& holds) {
  const Settings settings = std::exchange(request.settings, {});
  const Plan plan = make_plan(request, available, holds);
  for (const auto& setting : settings)
    if (knows(plan, technique, setting.first)) request.settings.push_back(setting);
  return request;
}

std::vector<const Technique*> techniques_with_effects() {
  std::vector<const Technique*> found;
  for (const Technique& technique : registry()) {
    const Effect& effect = technique.effect;
    if (!effect.name.empty() && effect.refines.empty() && effect.completes.empty()) found.push_back(&technique);
  }
  const auto place = [](const Technique* technique) {
    const std::vector<std::string>& parts = part_planes();
    return std::find(parts.begin(), parts.end(), technique->effect.changes);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Technique* a, const Technique* b) { return place(a) < place(b); });
  return found;
}

std::vector<const Technique*> techniques_that_complete(const Technique& technique) {
  std::vector<const Technique*> found;
  for (const Technique& t : registry()) {
    if (t.effect.completes == technique.name) found.push_back(&t);
  }
  return found;
}

std::vector<Plan> plans_of_effect(const Technique& technique, const PlanRequest& asked,
                                  const std::vector<std::string>& available, const std::string& holds) {
  check_settings(refinements_of(technique), asked);
  PlanRequest request = request_everywhere(technique, asked);
  request.only = technique.effect.mask;
  std::vector<Plan> plans = {make_plan(request, available, holds)};
  for (const Technique* refinement : refinements_of(technique)) {
    try {
      plans.push_back(make_plan(request_everywhere(*refinement, asked), available, holds));
    } catch (const UsageError&) {
      continue;
    } catch (const MissingPlanes&) {
      continue;
    }
  }
  return plans;
}

Decision decide(const Technique& technique, const EffectProbe& probe) {
  Decision decision{.effect = choose(technique, probe)};
  decision.everywhere = decision.request = request_everywhere(technique, probe.asked);
  if (!decision.effect.is_everywhere) decision.request.only = technique.effect.mask;
  const Technique* chosen = nullptr;
  for (const Technique* t : refinements_of(technique)) {
    // An effect that nothing visible calls for may still be needed for hidden layers, but not for agreement of two views.
    if (!decision.effect.is_wanted && t->views == 2) continue;
    decision.refinements.push_back(choose_refinement(*t, chosen, probe));
    const EffectChoice& refinement = decision.refinements.back();
    decision.effect.classify_ms += refinement.classify_ms;
    if (!refinement.is_wanted) continue;
    chosen = t;
    if (!decision.effect.is_wanted) decision.effect.why += fmt::format(" that is seen, but {}", refinement.why);
    decision.effect.is_wanted = true;
    decision.request = refined_request(refinement, technique, probe);
    // A refinement that only saves work does not matter if nothing is probed.
    if (t->effect.settings.empty()) decision.everywhere = request_everywhere(*t, probe.asked);
  }
  return decision;
}

Computed compute(Decision& decision, const EffectProbe& probe, MaskUse use) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool has_mask = !decision.request.only.empty();
  Computed done{.ms_masked = unknown, .ms_everywhere = unknown};
  if (!has_mask || use == MaskUse::never) {
    done.result = run(make_plan(has_mask ? decision.everywhere : decision.request, probe.available, probe.holds),
                      probe.frame, probe.device, probe.options);
    done.ms = least(done.result.total_ms);
    if (has_mask) done.ms_everywhere = done.ms;
    if (has_mask) leave_mask_out(decision, ", computed everywhere as asked");
    return done;
  }
  const Plan masked = make_plan(decision.request, probe.available, probe.holds);
  if (use == MaskUse::always) {
    done.result = run(masked, probe.frame, probe.device, probe.options);
    done.ms = done.ms_masked = least(done.result.total_ms);
    done.is_masked = true;
    return done;
  }
  const Plan everywhere = make_plan(decision.everywhere, probe.available, probe.holds);
  RunOptions once = probe.options;
  once.repeat = 1;
  RunResult with_mask, without;
  std::vector<double> ms_with, ms_without;
  // Alternating, so that other load on the machine affects both; the first round pays one-time costs of the device.
  for (int round = 0; round < std::max(least_rounds, probe.options.repeat); ++round) {
    with_mask = run(masked, probe.frame, probe.device, once);
    without = run(everywhere, probe.frame, probe.device, once);
    ms_with.push_back(with_mask.total_ms.front());
    ms_without.push_back(without.total_ms.front());
  }
  done.ms_masked = least(ms_with);
  done.ms_everywhere = least(ms_without);
  done.is_masked = done.ms_masked <= most_of_everywhere * done.ms_everywhere;
  done.ms = done.is_masked ? done.ms_masked : done.ms_everywhere;
  done.result = std::move(done.is_masked ? with_mask : without);
  if (done.is_masked)
    decision.effect.why += fmt::format("; the mask saves {:.0f} %", 100 * (1 - done.ms_masked / done.ms_everywhere));
  else
    leave_mask_out(decision,
                   fmt::format("; with a mask {:.2f} ms, everywhere {:.2f}", done.ms_masked, done.ms_everywhere));
  return done;
}

void probe_closely(EffectChoice& choice, const EffectProbe& probe) {
  if (choice.technique->effect.mask.empty()) return;
  EffectChoice closer{.technique = choice.technique};
  probe_mask(closer, probe, {}, choice.technique->effect.probe_resolution);
  choice.seen = std::move(closer.seen);
}

void take_planes(Frame& from, Frame& to) {
  for (View& view : from.views) {
    for (auto& [name, plane] : view.planes) to.view(view.name).planes[name] = std::move(plane);
  }
}

}  // namespace gloam
