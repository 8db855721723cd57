#include "gloam/compute.h"

#include <algorithm>

#include "base/lists.h"
#include "frame/two_cameras.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Whether the radius of a request's plan comes from its settings.
bool has_radius(const PlanRequest& request, const Plan& plan) {
  const std::optional<Radius> radius = radius_of(plan, request, RadiusSource::frame);
  return radius && radius->from == RadiusSource::flag;
}

/// A sentence if two eyes have no surface in common. Else empty.
std::string warning_about_views(const Plan& plan, const Frame& frame) {
  const auto is_of_two = [](const PlannedPass& planned) { return planned.technique->views == 2; };
  if (!std::any_of(plan.passes.begin(), plan.passes.end(), is_of_two) || frame.views.size() != 2) return "";
  for (const View& view : frame.views) {
    if (!view.find("depth") || !view.camera || !view.camera->pose) return "";  // another message says so
  }
  if (have_surface_in_common(frame)) return "";
  return fmt::format(
      "the views '{}' and '{}' have no surface in common, and each gets a result of its own; do both show "
      "one scene, each with its own camera?",
      frame.views[0].name, frame.views[1].name);
}

/// The radius of a map of relevant surfaces that the frame holds, where its header said it.
std::optional<double> radius_of_map(const Frame& frame) {
  if (const auto stored = frame.numbers.find("gloamStochasticRadius"); stored != frame.numbers.end())
    return stored->second;
  const auto parameters = frame.attributes.find("gloamParameters");
  return parameters == frame.attributes.end() ? std::nullopt : radius_of_relevant(parameters->second);
}

}  // namespace

std::string planes_in_words(const std::vector<std::string>& planes) {
  return planes.empty() ? "the frame has no plane" : "the frame has only " + enumerate(planes);
}

std::vector<std::string> notes_about_views(const Plan& plan, const Frame& frame) {
  std::vector<std::string> notes;
  if (const std::string warning = warning_about_views(plan, frame); !warning.empty()) notes.push_back(warning);
  if (const std::string warning = warning_about_map(plan, radius_of_map(frame)); !warning.empty())
    notes.push_back(warning);
  for (const PlannedPass& planned : plan.passes) {
    if (!planned.technique->assumes) continue;
    for (const View& view : frame.views) {
      const std::string assumed = view.camera ? planned.technique->assumes(planned.values, view) : "";
      if (!assumed.empty()) add_new(notes, {assumed});
    }
  }
  return notes;
}

Computation plan_on(const PlanRequest& request, const Frame& frame, const std::vector<std::string>& also) {
  check(frame);
  std::vector<std::string> planes = common_planes(frame);
  const std::string holds = planes_in_words(planes);
  add_new(planes, also);
  Computation computation{make_plan(request, planes, holds), {}, {}};
  check_stored_map(computation.plan, [&](const std::string& name) {
    const auto said = frame.attributes.find(name);
    return said == frame.attributes.end() ? "" : said->second;
  });
  computation.radius = radius_of(computation.plan, request, RadiusSource::flag);
  const bool is_given = request.radius || has_radius(request, computation.plan);
  if (computation.radius && !is_given) {
    const Radius made = default_radius(frame, stated_radius(frame));
    PlanRequest with_radius = request;
    with_radius.radius = made.value;
    computation.plan = make_plan(with_radius, planes, holds);
    computation.radius = radius_of(computation.plan, request, made.from);
  }
  if (computation.radius) {
    const std::string warning = warning_about(*computation.radius, frame, cap_of(computation.plan));
    if (!warning.empty()) computation.notes.push_back(warning);
  }
  add_new(computation.notes, notes_about_views(computation.plan, frame));
  return computation;
}

RunResult compute(const PlanRequest& request, const Frame& frame, Device& device, const RunOptions& options) {
  return run(plan_on(request, frame).plan, frame, device, options);
}

std::vector<float> ambient_occlusion(const Arrays& arrays, Device& device, const PlanRequest& request,
                                     const RunOptions& options) {
  PlanRequest for_ao = request;
  if (for_ao.outputs.empty()) for_ao.outputs = {"ao"};
  return values_of(compute(for_ao, frame_from(arrays), device, options).frame, "ao");
}

}  // namespace gloam
